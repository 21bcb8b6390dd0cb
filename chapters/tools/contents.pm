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

# The programs of a chapter's figures; NN_drawings.cpp draws anew in each build.
sub programs {
    my ($folder, $number) = @_;
    return grep { !/many_machines/ }
        map { sort glob sprintf "%s/%s/%02d_*.cpp", $folder, $_, $number } '../examples', 'experiments';
}

# What they are made of: if it is not what it was, the kept figures are older than it.
sub key {
    my ($folder, $number) = @_;
    my $sum = Digest::SHA->new(256);
    $sum->add(slurp($_)) for programs($folder, $number);
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

# Where and by what the kept figures of a chapter were made, and whether its programs are
# still what they were; nothing if there are none.
sub made {
    my ($folder, $number) = @_;
    my $path = sprintf '%s/kept/%02d/made.txt', $folder, $number;
    return if !-f $path;
    my ($key, $where) = split /\n/, slurp($path);
    return ($where, $key eq key($folder, $number));
}

sub chapters { return map { @{$_->{chapters}} } parts(@_) }

1;
