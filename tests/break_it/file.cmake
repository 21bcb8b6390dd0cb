# Who may read a file is forgotten.
ljus_break_it(NAME file-mode HEADER io/file_beside.hpp TEST file
    FROM "older.st_mode & 07777"
    TO   "0644"
    CASES "file: who may read it*")

# What nobody may write is replaced.
ljus_break_it(NAME file-read-only HEADER io/file_beside.hpp TEST file
    FROM "(status.st_mode & 0222) == 0"
    TO   "false"
    CASES "file: who may read it*")

# A hundred files that others left block the next save.
ljus_break_it(NAME file-names HEADER io/file_beside.hpp TEST file
    FROM "most_names = 10'000"
    TO   "most_names = 100"
    CASES "file: what others have left*" COMPILED)

# Written with a name from the beginning, so that a kill leaves it.
ljus_break_it(NAME file-nameless HEADER io/file_beside.hpp TEST file
    FROM "if (number < 0) return;"
    TO   "if (number < 0 || ::close(number) == 0) return;"
    CASES "file: a program that is killed*")

# A device is read as if it were a file.
ljus_break_it(NAME file-pipe HEADER io/file.hpp TEST file
    FROM "!S_ISREG(status.st_mode) &&"
    TO   "S_ISFIFO(status.st_mode) &&"
    CASES "file: a pipe and a device*")

# Control characters of two bytes pass.
ljus_break_it(NAME file-shown-control HEADER io/file_beside.hpp TEST file
    FROM "byte(i + 1) < 0xa0"
    TO   "byte(i + 1) < 0x80"
    CASES "file: a message shows letters*")

# Bytes that are no UTF-8 pass.
ljus_break_it(NAME file-shown-letters HEADER io/file_beside.hpp TEST file
    FROM "byte(i + k) >> 6 == 2"
    TO   "byte(i + k) >> 6 < 4"
    CASES "file: a message shows letters*")

# What was read is listed without what was in it.
ljus_break_it(NAME file-hash HEADER io/file.hpp TEST file
    FROM "notes->files_[number].hash = hash;"
    TO   "(void)hash;"
    CASES "file: a list has what*")

# What is left of a piece is lost.
ljus_break_it(NAME file-pieces HEADER io/file.hpp TEST file
    FROM "left = text.size() - used;"
    TO   "left = 0;"
    CASES "file: pieces*")

# What another process writes is taken for what a killed one has left.
ljus_break_it(NAME file-lock HEADER io/file_beside.hpp TEST file
    FROM "::flock(left, LOCK_EX | LOCK_NB) == 0 && "
    TO   ""
    CASES "file: what a killed program*")

# A link whose target is missing is replaced by a file.
ljus_break_it(NAME file-link-nowhere HEADER io/file_beside.hpp TEST file
    FROM "S_ISLNK(status.st_mode)"
    TO   "false"
    CASES "file: behind a symbolic link*")

# A file that Git LFS keeps is another kind of file.
ljus_break_it(NAME file-lfs HEADER io/file.hpp TEST file
    FROM "text.starts_with(\"version https://git-lfs.\")"
    TO   "false"
    CASES "file: a file that stands for*")

# What another thread reads is in the list, too.
ljus_break_it(NAME file-thread HEADER io/file.hpp TEST file
    FROM "thread_local FilesRead* list"
    TO   "static FilesRead* list"
    CASES "file: a list has what was read*")
