# The book's parts and chapters, as contents.md lists them.
package contents;
use strict;
use warnings;
use Digest::SHA;

sub slurp {
    my ($path) = @_;
    open my $file, '<', $path or die "cannot read $path: $!\n";
    local $/;
    return scalar <$file>;
}

# A list of parts: { name, chapters }; a chapter: { number, label, title, items, written }.
sub parts {
    my ($folder) = @_;
    my @parts;
    for my $line (split /\n/, slurp("$folder/contents.md")) {
        if ($line =~ /^\|\s*\|\s*\*\*(.+?)\*\*\s*\|/) {
            push @parts, {name => $1, chapters => []};
        } elsif ($line =~ /^\|\s*(\d+)\s*\|\s*\\(subpage|anchor)\s+(\w+)\s+"?([^"|]+?)"?\s*\|\s*(.*?)\s*\|/) {
            die "contents.md: chapter $1 stands in no part\n" if !@parts;
            push @{$parts[-1]{chapters}},
                {number => $1, label => $3, title => $4, items => $5, written => $2 eq 'subpage'};
        }
    }
    return @parts;
}

# What a chapter's figures depend on: the sources of its programs, examples/NN_*.cpp.
sub key {
    my ($folder, $number) = @_;
    my $sum = Digest::SHA->new(256);
    # NN_drawings.cpp draws anew in each build.
    my @programs = grep { !/_drawings\.cpp$/ } glob sprintf "%s/../examples/%02d_*.cpp", $folder, $number;
    $sum->add(slurp($_)) for sort @programs;
    return substr $sum->hexdigest, 0, 16;
}

# The pictures in report quality that belong to the repository: by the name of the PNG that
# a program writes { file, number of the chapter }.
sub kept {
    my ($folder) = @_;
    my %kept;
    return \%kept if !-f "$folder/kept/pictures.txt";
    for my $line (split /\n/, slurp("$folder/kept/pictures.txt")) {
        next if $line =~ /^#/;
        my ($picture, $file, $number) = split ' ', $line;
        $kept{$picture} = {file => $file, number => $number};
    }
    return \%kept;
}

# Where and by what the kept figures of a chapter were made, or nothing: there are none, or
# its programs are not what they were.
sub made {
    my ($folder, $number) = @_;
    my $path = sprintf '%s/kept/%02d/made.txt', $folder, $number;
    return undef if !-f $path;
    my ($key, $where) = split /\n/, slurp($path);
    return $key eq key($folder, $number) ? $where : undef;
}

sub chapters { return map { @{$_->{chapters}} } parts(@_) }

1;
