// SPDX-License-Identifier: BSD-3-Clause
// To be preloaded into the program by tests that run it a hundred times. Loading Gmsh's libraries takes longer than
// checking a scene; here they are loaded once, and the main() of the program runs in a forked child for each request.
// A request on standard input: the number of texts and a line feed, then the texts, each with a 0 behind it: files for
// standard output and standard error, then the words of the command line, the program first. The answer on standard
// output: a line with the exit code, or minus the number of the signal.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

typedef int main_function(int, char **, char **);

enum { most_texts = 1000, seconds = 200 };
static main_function *program;

static void redirect(const char *path, int flags, int to) {
    const int file = open(path, flags, 0600);
    if (file < 0 || dup2(file, to) < 0) _exit(125);
    close(file);
}

static int run(int count, char **texts, char **environment) {
    redirect("/dev/null", O_RDONLY, 0);
    redirect(texts[0], O_WRONLY | O_CREAT | O_TRUNC, 1);
    redirect(texts[1], O_WRONLY | O_CREAT | O_TRUNC, 2);
    alarm(seconds);
    return program(count - 2, texts + 2, environment);
}

static int serve(int argc, char **argv, char **environment) {
    (void)argc;
    (void)argv;
    unsetenv("LD_PRELOAD");
    char *line = NULL;
    size_t room = 0;
    while (getline(&line, &room, stdin) > 0) {
        static char *texts[most_texts + 1];
        static size_t rooms[most_texts + 1];
        const int count = atoi(line);
        if (count < 3 || count > most_texts) return 1;
        for (int i = 0; i < count; ++i)
            if (getdelim(&texts[i], &rooms[i], 0, stdin) <= 0) return 1;
        char *ended[most_texts + 1] = {NULL};
        for (int i = 0; i < count; ++i) ended[i] = texts[i];
        const pid_t child = fork();
        if (child == 0) return run(count, ended, environment);
        int status = 0;
        if (child < 0 || waitpid(child, &status, 0) < 0) return 1;
        printf("%d\n", WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status));
        fflush(stdout);
    }
    return 0;
}

// In place of the C library's, which the program's first instructions call.
__attribute__((visibility("default"))) int __libc_start_main(main_function *own, int argc, char **argv,
                                                             void (*init)(void), void (*fini)(void),
                                                             void (*unload)(void), void *stack_end) {
    typedef int start_function(main_function *, int, char **, void (*)(void), void (*)(void), void (*)(void), void *);
    start_function *start = (start_function *)dlsym(RTLD_NEXT, "__libc_start_main");
    program = own;
    return start(serve, argc, argv, init, fini, unload, stack_end);
}
