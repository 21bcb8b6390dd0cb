# The book's parts and chapters, as contents.md lists them.
package contents;
use strict;
use warnings;

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

sub chapters { return map { @{$_->{chapters}} } parts(@_) }

1;
