/* The first process of the virtual machine: runs the lines of /tests one after the other, says how each ended, and
 * switches the machine off.
 *
 *   NAME [user=ID] [groups=ID,ID] [hold=LINE] [hide=PATH] [term=MS] [int=MS] : PROGRAM ARGUMENT...
 *
 * user, groups  as whom it runs (0, and none)
 * hold          this line of the chip is requested by "another" meanwhile
 * hide          this device is not there meanwhile
 * term, int     it gets this signal after so many milliseconds, unless it has ended
 * Line 7, MARK, is high while it runs. What it writes stands between "begin NAME" and "end NAME STATUS"; a signal that
 * ended it is 128 and its number; what takes longer than a minute is killed. "line NUMBER NAME: free" or
 * "used by WHOM" of all lines follows.
 *
 * SPDX-License-Identifier: MIT
 */
#include <fcntl.h>
#include <grp.h>
#include <linux/gpio.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/reboot.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MARK = 7, LINES = 8, WORDS = 64, PATIENCE_MS = 60000 };

struct test {
    char *name, *hide, *argv[WORDS];
    uid_t user;
    gid_t groups[8];
    size_t n_groups;
    int hold, signal; /* -1, 0: none */
    long after_ms;
};

static int chip;

static void die(const char *what)
{
    perror(what);
    (void)reboot(RB_POWER_OFF);
}

/* ---- Lines -------------------------------------------------------------------------------------------------- */

/* An output, low, until the file returned is closed. */
static int request(unsigned line, const char *consumer)
{
    struct gpio_v2_line_request r = { .num_lines = 1, .config.flags = GPIO_V2_LINE_FLAG_OUTPUT };
    r.offsets[0] = line;
    (void)snprintf(r.consumer, sizeof r.consumer, "%s", consumer);
    if (ioctl(chip, GPIO_V2_GET_LINE_IOCTL, &r) < 0)
        die("init: a line");
    return r.fd;
}

static void set(int line, int level)
{
    struct gpio_v2_line_values v = { (unsigned long long)level, 1 };
    if (ioctl(line, GPIO_V2_LINE_SET_VALUES_IOCTL, &v) < 0)
        die("init: a level");
}

static void show_lines(void)
{
    for (unsigned i = 0; i < LINES; i++) {
        struct gpio_v2_line_info info = { .offset = i };
        if (ioctl(chip, GPIO_V2_GET_LINEINFO_IOCTL, &info) < 0)
            die("init: what a line is");
        if (info.flags & GPIO_V2_LINE_FLAG_USED)
            printf("line %u %s: used by %s\n", i, info.name, info.consumer);
        else
            printf("line %u %s: free\n", i, info.name);
    }
}

/* ---- A test ------------------------------------------------------------------------------------------------- */

static void take_groups(struct test *t, char *list)
{
    for (char *at = list; at && t->n_groups < sizeof t->groups / sizeof t->groups[0]; at = strchr(at, ',')) {
        at += *at == ',';
        t->groups[t->n_groups++] = (gid_t)atoi(at);
    }
}

/* 0: the line makes no sense. */
static int parse(struct test *t, char *line)
{
    *t = (struct test){ .hold = -1 };
    t->name = strtok(line, " \n");
    char *word = t->name ? strtok(NULL, " \n") : NULL;
    for (; word && strcmp(word, ":"); word = strtok(NULL, " \n")) {
        char *value = strchr(word, '=');
        if (!value)
            return 0;
        *value++ = '\0';
        if (!strcmp(word, "user"))
            t->user = (uid_t)atoi(value);
        else if (!strcmp(word, "groups"))
            take_groups(t, value);
        else if (!strcmp(word, "hide"))
            t->hide = value;
        else if (!strcmp(word, "hold"))
            t->hold = atoi(value);
        else if (!strcmp(word, "term") || !strcmp(word, "int")) {
            t->signal = *word == 't' ? SIGTERM : SIGINT;
            t->after_ms = atol(value);
        } else
            return 0;
    }
    for (int n = 0; word && n < WORDS - 1; n++)
        t->argv[n] = word = strtok(NULL, " \n");
    return t->argv[0] != NULL;
}

static void become(const struct test *t, const sigset_t *mask)
{
    if (setgroups(t->n_groups, t->groups) || setgid(t->user) || setuid(t->user) ||
        sigprocmask(SIG_UNBLOCK, mask, NULL))
        perror("init: user");
    else
        (void)execv(t->argv[0], t->argv);
    perror(t->argv[0]);
    _exit(127);
}

/* Has a child ended within so many milliseconds? */
static int ends_within(const sigset_t *child, long ms)
{
    const struct timespec limit = { ms / 1000, ms % 1000 * 1000000 };
    return sigtimedwait(child, NULL, &limit) == SIGCHLD;
}

static void run(const struct test *t, int mark)
{
    const int held = t->hold >= 0 ? request((unsigned)t->hold, "another") : -1;
    sigset_t child;
    int status;
    (void)sigemptyset(&child);
    (void)sigaddset(&child, SIGCHLD);
    (void)sigprocmask(SIG_BLOCK, &child, NULL);
    if (t->hide && rename(t->hide, "/dev/hidden"))
        die(t->hide);
    printf("begin %s\n", t->name);
    set(mark, 1);
    const pid_t pid = fork();
    if (pid == 0)
        become(t, &child);
    int over = t->signal ? ends_within(&child, t->after_ms) : 0;
    if (!over && t->signal)
        (void)kill(pid, t->signal);
    if (!over && !ends_within(&child, PATIENCE_MS))
        (void)kill(pid, SIGKILL);
    (void)waitpid(pid, &status, 0);
    set(mark, 0);
    printf("\nend %s %d\n", t->name, WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
    if (held >= 0)
        (void)close(held);
    if (t->hide && rename("/dev/hidden", t->hide))
        die(t->hide);
    show_lines();
}

/* ---- The machine -------------------------------------------------------------------------------------------- */

/* As a distribution's rules leave a device: for its group alone. */
static void give(const char *path, gid_t group)
{
    if (chown(path, 0, group) || chmod(path, 0660))
        die(path);
}

static void show_file(const char *name, const char *path)
{
    char text[64] = "?\n";
    FILE *f = fopen(path, "r");
    if (f) {
        (void)fgets(text, sizeof text, f);
        (void)fclose(f);
    }
    printf("%s %s", name, text);
}

int main(void)
{
    static char line[4096];
    struct utsname kernel;
    struct test test;
    (void)mkdir("/dev", 0755), (void)mkdir("/sys", 0755), (void)mkdir("/proc", 0755);
    if (mount("devtmpfs", "/dev", "devtmpfs", 0, NULL) || mount("sysfs", "/sys", "sysfs", 0, NULL) ||
        mount("proc", "/proc", "proc", 0, NULL))
        (void)reboot(RB_POWER_OFF);
    const int console = open("/dev/console", O_RDWR);
    for (int fd = 0; fd < 3; fd++)
        (void)dup2(console, fd);
    (void)setvbuf(stdout, NULL, _IONBF, 0);
    chip = open("/dev/gpiochip0", O_RDWR);
    if (chip < 0)
        die("/dev/gpiochip0");
    give("/dev/gpiochip0", 20);
    give("/dev/spidev0.0", 21);
    (void)uname(&kernel);
    printf("kernel %s\n", kernel.release);
    show_file("bufsiz", "/sys/module/spidev/parameters/bufsiz");
    const int mark = request(MARK, "init");
    FILE *tests = fopen("/tests", "r");
    while (tests && fgets(line, sizeof line, tests)) {
        if (parse(&test, line))
            run(&test, mark);
        else
            printf("init: not a test: %s\n", line);
    }
    puts("done");
    sync();
    (void)reboot(RB_POWER_OFF);
    return 0;
}
