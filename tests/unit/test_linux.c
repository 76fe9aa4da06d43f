/* hal/linux and zstrip-linux on a machine that is made up here: GPIO chips, a spidev whose messages go into the model
 * of a panel, device nodes in a folder, and a clock that passes by sleeping alone. tests.mk links it in place of
 * libgpiod and of some calls of the C library (--wrap).
 *
 * What only a kernel can tell (does the driver take this ioctl, what is on the pins) is tests/boards/linux.sh's.
 *
 * SPDX-License-Identifier: MIT
 */
#define _GNU_SOURCE
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <grp.h>
#include <linux/spi/spidev.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "cases.h"
#include "gpio.h"
#include "hal.h"
#include "image.h"
#include "linux.h"
#include "panel.h"
#include "panel_frame.h"
#include "prng.h"
#include "scenes.h"

#define CHIPS 3
#define LINES 8
#define MESSAGES 20000

/* ---- The machine --------------------------------------------------------------------------------------------- */

struct line {
    const char *name, *holder; /* holder: another program; NULL: free */
    int held, level, input;    /* by us */
};

struct message {
    const uint8_t *at;
    uint32_t n;
    int dc;
};

static struct machine {
    struct {
        const char *label;
        int denied; /* errno of opening it */
        struct line line[LINES];
    } chip[CHIPS];
    int chips_open, requests;
    const char *bufsiz;          /* what its file says; NULL: there is none */
    int open_errno;              /* of the spidev */
    mode_t node_mode;            /* of all nodes */
    gid_t node_gid;              /* 7 is called "owners" */
    unsigned long bad_request;   /* the ioctl that fails, with bad_errno; 0: none */
    int bad_errno;
    uint32_t bad_from, bad_to;   /* messages that fail, counted from 0 */
    uint32_t speed;
    uint8_t mode, bits;
    uint32_t n_sent, limit;      /* limit: what the kernel takes */
    int n_open;                  /* spidevs */
    int edges_before, edges;     /* of the input: from before a wait; to come */
    int edge_errno;
    int edge_signal;             /* flag: SIGTERM comes in the wait for an edge */
    int interrupts;              /* ioctls to come that fail with EINTR */
    uint32_t signal_at;          /* the message in which the signal comes, SIGTERM where it is 0; 0: none */
    int signal, no_hup;          /* no_hup: SIGHUP is ignored from the start, as by nohup */
    uint32_t draw_us;            /* that drawing a strip takes at least */
    uint32_t wire_hz;            /* 0: messages take no time, else what they take at this clock */
    sem_t *begun, *go;           /* where not NULL: each message of data says that it has begun, and waits to go on */
    uint64_t slept_us;
    struct pm_model *model;
    uint8_t *lit;                /* what the model showed when it was last told to be dark, RGB; NULL: not wanted */
    int n_lit, light_on;         /* light_on: it was on then */
    int lights;                  /* how often the light was switched on */
    struct message sent[MESSAGES]; /* the last one here (machine()) */
} m;
static int in_message; /* atomic: a message is on the wire */
static void (*handler)(int); /* the program's, of any signal */
static int handled;    /* atomic: it has run */
static char folder[] = "/tmp/zstrip-dev-XXXXXX";

/* What the made-up machine insists on. It is asked from another thread and from children too, which cmocka's asserts
 * must not leave. */
#define MUST(condition) ((condition) ? (void)0 : must(__LINE__, #condition))
static void must(int line, const char *what)
{
    (void)fprintf(stderr, "FAILED test_linux: line %d: %s\n", line, what);
    _exit(1);
}

static int removed(const char *path, const struct stat *is, int flag, struct FTW *at)
{
    return remove(path);
}

/* The folder and what is in it. By calls: a shell takes as long to start as most runs of the program. */
static int remove_folder(void)
{
    return nftw(folder, removed, 8, FTW_DEPTH | FTW_PHYS);
}

static void devices(const char *names) /* with blanks between; "x@" is a symbolic link */
{
    char path[128], list[256];
    assert_int_equal(remove_folder(), 0);
    assert_int_equal(mkdir(folder, 0777), 0);
    (void)snprintf(list, sizeof list, "%s", names);
    for (char *name = strtok(list, " "); name; name = strtok(NULL, " ")) {
        const size_t n = strlen(name);
        const int link = name[n - 1] == '@';
        name[n - (size_t)link] = '\0';
        (void)snprintf(path, sizeof path, "%s/%s", folder, name);
        if (link)
            assert_int_equal(symlink("null", path), 0);
        else
            assert_int_equal(close(creat(path, 0600)), 0);
    }
}

static void machine(void)
{
    pm_free(m.model);
    /* not all of sent: each page that is written is the kernel's work after each fork */
    memset(m.sent, 0, (m.n_sent < MESSAGES ? m.n_sent : MESSAGES) * sizeof m.sent[0]);
    memset(&m, 0, offsetof(struct machine, sent));
    m.bufsiz = "4096\n";
    m.limit = 4096;
    m.node_mode = 0660;
    m.node_gid = 7;
    m.chip[0].label = "pinctrl-test";
    m.chip[1].label = "expander";
    m.chip[2].label = "expander2";
    m.chip[0].line[3].name = "TEAR";
    m.chip[0].line[4].name = "DC";
    m.chip[0].line[5].name = "RST";
    m.chip[0].line[6].name = "LIGHT";
    m.chip[1].line[0].name = m.chip[1].line[7].name = "TWICE";
    m.chip[0].line[2].name = "CE0";
    m.chip[0].line[2].holder = "spi0 CS0";
    devices("gpiochip0 gpiochip1 gpiochip2 spidev0.0 null");
}

static void model_of(const char *panel)
{
    struct pm_glass glass;
    MUST(pm_glass_named(&glass, panel));
    pm_free(m.model);
    m.model = pm_new(&glass);
    MUST(m.model != NULL);
    pm_elapsed(m.model, 0);
}

static int number_of(const char *path)
{
    char real[128];
    struct stat st;
    (void)snprintf(real, sizeof real, "%s/%s", folder, path + strlen("/dev/"));
    if (strncmp(path, "/dev/gpiochip", 13) != 0 || stat(real, &st) || path[13] < '0' || path[13] >= '0' + CHIPS) {
        errno = ENOENT;
        return -1;
    }
    return path[13] - '0';
}

void *gpio_chip_open(const char *path)
{
    const int n = number_of(path);
    if (n < 0)
        return NULL;
    if (m.chip[n].denied) {
        errno = m.chip[n].denied;
        return NULL;
    }
    m.chips_open++;
    return &m.chip[n];
}

void gpio_chip_close(void *chip)
{
    MUST(chip != NULL);
    m.chips_open--;
}

static int index_of(void *chip)
{
    for (int i = 0; i < CHIPS; i++)
        if (chip == &m.chip[i])
            return i;
    MUST(0);
    return 0;
}

int gpio_chip_look(void *chip, char label[GPIO_TEXT], uint32_t *n_lines)
{
    (void)snprintf(label, GPIO_TEXT, "%s", m.chip[index_of(chip)].label);
    *n_lines = LINES;
    return 0;
}

int gpio_line_look(void *chip, uint32_t offset, struct gpio_info *info)
{
    const struct line *l = &m.chip[index_of(chip)].line[offset];
    MUST(offset < LINES);
    (void)snprintf(info->name, GPIO_TEXT, "%s", l->name ? l->name : "");
    (void)snprintf(info->consumer, GPIO_TEXT, "%s", l->holder ? l->holder : "");
    info->used = l->holder != NULL || l->held;
    return 0;
}

int gpio_request(struct gpio_line *line, const char *path, uint32_t offset, enum gpio_use use, const char *consumer)
{
    const int n = number_of(path);
    if (n < 0 || m.chip[n].denied)
        return -1;
    struct line *l = &m.chip[n].line[offset];
    MUST(strncmp(consumer, "zstrip ", 7) == 0);
    if (l->held || l->holder) {
        errno = EBUSY;
        return -1;
    }
    m.requests++;
    l->held = 1;
    l->input = use == GPIO_EDGES;
    l->level = use == GPIO_HIGH;
    *line = (struct gpio_line){ NULL, l, offset };
    return 0;
}

int gpio_set(struct gpio_line *line, int level)
{
    struct line *l = line->held;
    MUST(l->held && !l->input);
    MUST(!__atomic_load_n(&in_message, __ATOMIC_SEQ_CST)); /* no line changes while bytes are on the wire */
    if (m.model && l == &m.chip[0].line[5] && level && !l->level)
        pm_reset(m.model);
    l->level = level;
    m.lights += level && l == &m.chip[0].line[6];
    return 0;
}

int gpio_edge(struct gpio_line *line, uint32_t ms)
{
    struct line *l = line->held;
    MUST(l->held && l->input);
    if (m.edge_errno) {
        errno = m.edge_errno;
        return -1;
    }
    if (m.edges_before) {
        m.edges_before--;
        return 1;
    }
    if (ms == 0)
        return 0;
    if (m.edge_signal) {
        (void)raise(SIGTERM);
        errno = EINTR;
        return -1;
    }
    m.slept_us += 1000u * ms;
    return m.edges > 0 && m.edges-- > 0;
}

void gpio_release(struct gpio_line *line)
{
    if (line->held)
        ((struct line *)line->held)->held = 0;
    *line = (struct gpio_line){ 0 };
}

static int held_lines(void)
{
    int n = 0;
    for (int i = 0; i < CHIPS; i++)
        for (int k = 0; k < LINES; k++)
            n += m.chip[i].line[k].held;
    return n;
}

/* ---- Calls of the C library ------------------------------------------------------------------------------------ */

int __real_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...);
int __real_ioctl(int fd, unsigned long request, ...);
int __wrap_ioctl(int fd, unsigned long request, ...);
int __real_stat(const char *path, struct stat *st);
int __wrap_stat(const char *path, struct stat *st);
int __real_lstat(const char *path, struct stat *st);
int __wrap_lstat(const char *path, struct stat *st);
int __wrap_access(const char *path, int how);
struct group *__wrap_getgrgid(gid_t gid);
DIR *__real_opendir(const char *path);
DIR *__wrap_opendir(const char *path);
int __wrap_nanosleep(const struct timespec *wanted, struct timespec *left);

/* A path of /dev in the folder; others as they are. */
static const char *mapped(const char *path)
{
    static __thread char real[192];
    (void)snprintf(real, sizeof real, "%s%s", folder, path + 4);
    return strncmp(path, "/dev", 4) == 0 ? real : path;
}

int __wrap_open(const char *path, int flags, ...)
{
    int ends[2];
    if (strcmp(path, "/sys/module/spidev/parameters/bufsiz") == 0) {
        if (!m.bufsiz) {
            errno = ENOENT;
            return -1;
        }
        MUST(pipe(ends) == 0);
        MUST(write(ends[1], m.bufsiz, strlen(m.bufsiz)) == (ssize_t)strlen(m.bufsiz));
        (void)close(ends[1]);
        return ends[0];
    }
    if (strncmp(path, "/dev/spidev", 11) == 0 && m.open_errno) {
        errno = m.open_errno;
        return -1;
    }
    return __real_open(mapped(path), flags);
}

int __wrap_stat(const char *path, struct stat *st)
{
    const int err = __real_stat(mapped(path), st);
    if (!err && mapped(path) != path) {
        st->st_mode = m.node_mode | S_IFCHR;
        st->st_gid = m.node_gid;
    }
    return err;
}

struct group *__wrap_getgrgid(gid_t gid)
{
    static struct group owners = { .gr_name = (char *)"owners" };
    return gid == 7 ? &owners : NULL;
}

int __wrap_lstat(const char *path, struct stat *st)
{
    const int err = __real_lstat(mapped(path), st);
    if (!err && S_ISREG(st->st_mode))
        st->st_mode = (st->st_mode & 07777u) | S_IFCHR;
    return err;
}

int __wrap_access(const char *path, int how)
{
    (void)path;
    (void)how;
    errno = m.open_errno;
    return m.open_errno ? -1 : 0;
}

DIR *__wrap_opendir(const char *path)
{
    return __real_opendir(mapped(path));
}

int __wrap_nanosleep(const struct timespec *wanted, struct timespec *left)
{
    const uint64_t us = (uint64_t)wanted->tv_sec * 1000000u + (uint64_t)wanted->tv_nsec / 1000u;
    (void)left;
    m.slept_us += us;
    if (m.model)
        pm_elapsed(m.model, (uint32_t)us);
    return 0;
}

void __real_zs_raster_strip(struct zs_renderer *r);
void __wrap_zs_raster_strip(struct zs_renderer *r);
void __wrap_zs_raster_strip(struct zs_renderer *r)
{
    if (m.draw_us)
        (void)usleep(m.draw_us);
    __real_zs_raster_strip(r);
}

/* Before a command that may be the last one: other bytes with D/C low that look like it are followed by more. */
static void look_at_model(uint8_t command)
{
    if ((command == 0x28 || command == 0xae) && m.lit && m.model && pm_lit(m.model)) {
        pm_picture(m.model, m.lit, NULL);
        m.n_lit++;
        m.light_on = m.chip[0].line[6].level;
    }
}

static void handle(int number)
{
    handler(number);
    __atomic_store_n(&handled, 1, __ATOMIC_SEQ_CST);
}

int __real_sigaction(int number, const struct sigaction *action, struct sigaction *before);
int __wrap_sigaction(int number, const struct sigaction *action, struct sigaction *before);
int __wrap_sigaction(int number, const struct sigaction *action, struct sigaction *before)
{
    struct sigaction ours;
    if (!action || action->sa_handler == SIG_IGN)
        return __real_sigaction(number, action, before);
    ours = *action;
    handler = action->sa_handler;
    ours.sa_handler = handle;
    return __real_sigaction(number, &ours, before);
}

/* A signal to the process, taken before this goes on, by whichever thread; or ignored. A machine that is busy may let
 * this thread run on for many messages before another takes it. */
static void interrupt(int number)
{
    struct sigaction now;
    MUST(__real_sigaction(number, NULL, &now) == 0);
    (void)kill(getpid(), number);
    while (now.sa_handler == handle && !__atomic_load_n(&handled, __ATOMIC_SEQ_CST))
        (void)usleep(100); /* the child's alarm ends what never ends */
}

static int message(const struct spi_ioc_transfer *t)
{
    const uint8_t *bytes = (const uint8_t *)(uintptr_t)t->tx_buf;
    const int dc = m.chip[0].line[4].level;
    const uint32_t k = m.n_sent;
    if (t->len > m.limit) {
        errno = EMSGSIZE;
        return -1;
    }
    if (m.n_sent < MESSAGES)
        m.sent[m.n_sent] = (struct message){ bytes, t->len, dc };
    m.n_sent++;
    __atomic_store_n(&in_message, 1, __ATOMIC_SEQ_CST);
    if (m.signal_at && k == m.signal_at)
        interrupt(m.signal ? m.signal : SIGTERM);
    if (dc && t->len > 16 && m.begun) {
        struct timespec until;
        (void)clock_gettime(CLOCK_REALTIME, &until);
        until.tv_sec += 5; /* then the test has failed, and goes on to say so */
        (void)sem_post(m.begun);
        (void)sem_timedwait(m.go, &until);
    }
    if (m.wire_hz)
        (void)usleep((useconds_t)(8e6 * t->len / m.wire_hz));
    if (!dc && t->len == 1)
        look_at_model(bytes[0]);
    const int fails = k >= m.bad_from && k < m.bad_to;
    for (uint32_t i = 0; m.model && i < (fails ? t->len / 2u : t->len); i++)
        pm_byte(m.model, bytes[i], dc);
    if (m.model)
        pm_deselect(m.model);
    __atomic_store_n(&in_message, 0, __ATOMIC_SEQ_CST);
    errno = m.bad_errno;
    return fails ? -1 : (int)t->len;
}

int __wrap_ioctl(int fd, unsigned long request, ...)
{
    va_list args;
    va_start(args, request);
    const void *at = va_arg(args, const void *);
    va_end(args);
    MUST(fd >= 0);
    if (m.interrupts > 0) {
        m.interrupts--;
        errno = EINTR;
        return -1;
    }
    if (request == m.bad_request) {
        errno = m.bad_errno;
        return -1;
    }
    if (request == SPI_IOC_MESSAGE(1))
        return message(at);
    if (request == SPI_IOC_WR_MODE)
        m.mode = *(const uint8_t *)at;
    else if (request == SPI_IOC_WR_BITS_PER_WORD)
        m.bits = *(const uint8_t *)at;
    else if (request == SPI_IOC_WR_MAX_SPEED_HZ)
        m.speed = *(const uint32_t *)at;
    else
        MUST(0);
    return 0;
}

/* ---- Opening ----------------------------------------------------------------------------------------------------- */

static const struct linux_wiring all_wired = { "/dev/spidev0.0", 8000000, 3, "DC", "RST", "LIGHT", "TEAR" };

static void open_as(const struct linux_wiring *wiring)
{
    linux_wire(wiring);
    if (hal_init() != HAL_ERR_NONE)
        fail_msg("%s", linux_why());
}

static void expect_shut(void)
{
    linux_close();
    assert_int_equal(held_lines(), 0);
    assert_int_equal(m.chips_open, 0);
}

static void lines_are_held_from_first_to_last(void **state)
{
    machine();
    open_as(&all_wired);
    assert_int_equal(m.requests, 4);
    assert_int_equal(held_lines(), 4);
    assert_int_equal(m.speed, 8000000);
    assert_int_equal(m.mode, 3);
    assert_int_equal(m.bits, 8);
    assert_true(m.chip[0].line[5].level); /* RESET is not pulled */
    assert_false(m.chip[0].line[6].level); /* dark */
    hal_backlight(1);
    assert_true(m.chip[0].line[6].level);
    for (int i = 0; i < 20; i++)
        assert_int_equal(hal_bus()->command(hal_bus(), 0x2a, (const uint8_t *)"abcd", 4), HAL_ERR_NONE);
    assert_int_equal(m.requests, 4);
    assert_int_equal(hal_init(), HAL_ERR_NONE); /* no effect */
    assert_int_equal(m.requests, 4);
    linux_close();
    assert_false(m.chip[0].line[6].level);
    expect_shut();
    assert_int_equal(hal_bus()->command(hal_bus(), 0, NULL, 0), HAL_ERR_STATE);
}

static void lines_by_name_label_and_number(void **state)
{
    static const struct {
        const char *text;
        int chip, line;
    } t[] = { { "DC", 0, 4 },          { "gpiochip1:3", 1, 3 }, { "1:3", 1, 3 },          { "/dev/gpiochip2:1", 2, 1 },
              { "expander:5", 1, 5 },  { "expander2:0", 2, 0 }, { "pinctrl-test:DC", 0, 4 }, { "0:TEAR", 0, 3 } };
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++) {
        const struct linux_wiring w = { "/dev/spidev0.0", 1000000, 0, t[i].text, NULL, NULL, NULL };
        machine();
        open_as(&w);
        assert_true(m.chip[t[i].chip].line[t[i].line].held);
        assert_int_equal(held_lines(), 1);
        assert_int_equal(linux_wait_edge(1), HAL_ERR_STATE);
        expect_shut();
    }
}

/* Each way to fail: the sentence names the thing and its cure, nothing stays open. */
static void refusals(void **state)
{
    static const char *const spi = "/dev/spidev0.0";
    struct refusal {
        struct linux_wiring w;
        int err;
        const char *thing, *cure;
        const char *nodes;          /* NULL: the usual */
        int open_errno, denied;
        unsigned long request;
        int request_errno;
        mode_t mode;                /* 0: 0660 */
        gid_t gid;                  /* 0: 7 */
    } t[] = {
        { { spi, 1, 0, "NOPE", 0, 0, 0 }, HAL_ERR_ARG, "'NOPE'", "CHIP:LINE", 0, 0, 0, 0, 0 },
        { { spi, 1, 0, "DC", "5", 0, 0 }, HAL_ERR_ARG, "RESET: no line here is named '5'", "CHIP:LINE", 0, 0, 0, 0, 0 },
        { { spi, 1, 0, "TWICE", 0, 0, 0 }, HAL_ERR_ARG, "2 lines", "/dev/gpiochip1:0, /dev/gpiochip1:7", 0, 0, 0, 0,
          0 },
        { { spi, 1, 0, "0:8", 0, 0, 0 }, HAL_ERR_ARG, "0 to 7", "give one", 0, 0, 0, 0, 0 },
        { { spi, 1, 0, "0:FOO", 0, 0, 0 }, HAL_ERR_ARG, "no line 'FOO'", "numbers or names", 0, 0, 0, 0, 0 },
        { { spi, 1, 0, "0:", 0, 0, 0 }, HAL_ERR_ARG, "no line ''", "numbers or names", 0, 0, 0, 0, 0 },
        { { spi, 1, 0, "7:1", 0, 0, 0 }, HAL_ERR_ARG, "/dev/gpiochip7", "name a chip", 0, 0, 0, 0, 0 },
        { { spi, 1, 0, "what:1", 0, 0, 0 }, HAL_ERR_ARG, "'what'", "name one", 0, 0, 0, 0, 0 },
        { { spi, 1, 0, "DC", "0:4", 0, 0 }, HAL_ERR_ARG, "D/C and RESET", "its own", 0, 0, 0, 0, 0 },
        { { spi, 1, 0, "DC", "CE0", 0, 0 }, HAL_ERR_BUS, "RESET: line /dev/gpiochip0:2, CE0 is held by spi0 CS0",
          "stop that program", 0, 0, 0, 0, 0 },
        { { spi, 1, 0, "DC", 0, 0, 0 }, HAL_ERR_BUS, "no GPIO chip at all", "driver", "spidev0.0", 0, 0, 0, 0 },
        { { spi, 1, 0, "0:4", 0, 0, 0 }, HAL_ERR_BUS, "D/C: /dev/gpiochip0 is open to the group owners", "-aG owners",
          0, 0, EACCES, 0, 0 },
        { { spi, 1, 0, "DC", 0, 0, 0 }, HAL_ERR_BUS, "/dev/gpiochip0", "-aG owners", 0, 0, EACCES, 0, 0 },
        { { spi, 1, 0, "0:4", 0, 0, 0 }, HAL_ERR_BUS, "D/C: /dev/gpiochip0", "container", 0, 0, EPERM, 0, 0 },
        { { spi, 1, 0, "0:4", 0, 0, 0 }, HAL_ERR_BUS, "root alone", "KERNEL==\"gpiochip0\"", 0, 0, EACCES, 0, 0,
          0600, 0 },
        { { spi, 1, 0, "0:4", 0, 0, 0 }, HAL_ERR_ARG, "/dev/gpiochip0 is no GPIO chip", "name one", 0, 0, ENODEV, 0,
          0 },
        { { spi, 1, 0, "0:4", 0, 0, 0 }, HAL_ERR_BUS, "/dev/gpiochip0", "name another", 0, 0, EMFILE, 0, 0 },
        { { spi, 1, 0, "DC", 0, 0, 0 }, HAL_ERR_BUS, spi, "-aG owners", 0, EACCES, 0, 0, 0 },
        { { spi, 1, 0, "DC", 0, 0, 0 }, HAL_ERR_BUS, "group 9,", "-aG 9 ", 0, EACCES, 0, 0, 0, 0660, 9 },
        { { spi, 1, 0, "DC", 0, 0, 0 }, HAL_ERR_BUS, "root alone", "KERNEL==\"spidev0.0\"", 0, EACCES, 0, 0, 0, 0640 },
        { { spi, 1, 0, "DC", 0, 0, 0 }, HAL_ERR_BUS, spi, "--device /dev/spidev0.0", 0, EPERM, 0, 0, 0 },
        { { spi, 1, 0, "DC", 0, 0, 0 }, HAL_ERR_BUS, "buffers of 4096 bytes", "spidev.bufsiz", 0, ENOMEM, 0, 0, 0 },
        { { spi, 1, 0, "DC", 0, 0, 0 }, HAL_ERR_BUS, spi, "dmesg", 0, EIO, 0, 0, 0 },
        { { spi, 1, 0, "DC", 0, 0, 0 }, HAL_ERR_BUS, spi, "dtparam=spi=on", "gpiochip0", ENOENT, 0, 0, 0 },
        { { "/dev/spidev9.0", 1, 0, "DC", 0, 0, 0 }, HAL_ERR_BUS, "/dev/spidev9.0", "there is /dev/spidev0.0", 0,
          ENOENT, 0, 0, 0 },
        { { spi, 1, 0, "DC", 0, 0, 0 }, HAL_ERR_BUS, spi, "driver", 0, ENODEV, 0, 0, 0 },
        { { spi, 1, 3, "DC", "RST", 0, 0 }, HAL_ERR_BUS, "mode 3", "another device", 0, 0, 0, SPI_IOC_WR_MODE, EINVAL },
        { { spi, 1, 0, "DC", "RST", 0, 0 }, HAL_ERR_BUS, "8 bits", "another device", 0, 0, 0, SPI_IOC_WR_BITS_PER_WORD,
          EINVAL },
        { { spi, 77, 0, "DC", "RST", 0, 0 }, HAL_ERR_BUS, "77 Hz", "another speed", 0, 0, 0, SPI_IOC_WR_MAX_SPEED_HZ,
          EINVAL },
        { { spi, 1, 0, "DC", "RST", 0, 0 }, HAL_ERR_BUS, "no spidev", "/dev/spidev0.0", 0, 0, 0, SPI_IOC_WR_MODE,
          ENOTTY },
        { { spi, 0, 0, "DC", 0, 0, 0 }, HAL_ERR_ARG, "0 Hz", "needs", 0, 0, 0, 0, 0 },
        { { spi, 1, 0, NULL, 0, 0, 0 }, HAL_ERR_ARG, "D/C", "needs", 0, 0, 0, 0, 0 },
    };
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++) {
        machine();
        if (t[i].nodes)
            devices(t[i].nodes);
        m.open_errno = t[i].open_errno;
        m.node_mode = t[i].mode ? t[i].mode : m.node_mode;
        m.node_gid = t[i].gid ? t[i].gid : m.node_gid;
        m.bad_request = t[i].request;
        m.bad_errno = t[i].request_errno;
        for (int k = 0; k < CHIPS; k++)
            m.chip[k].denied = t[i].denied;
        linux_wire(&t[i].w);
        const int err = hal_init();
        if (err != t[i].err || !strstr(linux_why(), t[i].thing) || !strstr(linux_why(), t[i].cure))
            fail_msg("row %zu: %d, %s", i, err, linux_why());
        assert_int_equal(held_lines(), 0);
        assert_int_equal(m.chips_open, 0);
        assert_int_equal(m.n_sent, 0);
        assert_int_equal(hal_bus()->data(hal_bus(), (const uint8_t *)"ab", 2), HAL_ERR_STATE);
    }
}

static void names_of_devices(void **state)
{
    struct gpio_place place;
    char text[4096] = { 0 };
    FILE *to = fmemopen(text, sizeof text, "w");
    machine();
    devices("gpiochip2 gpiochip1@ gpiochip0 gpiochipX gpiochip null");
    linux_list_lines(to);
    (void)fclose(to);
    assert_non_null(strstr(text, "gpiochip0:2"));
    assert_non_null(strstr(text, "held by spi0 CS0"));
    assert_non_null(strstr(text, "gpiochip2:7"));
    assert_true(strstr(text, "gpiochip2:7") > strstr(text, "gpiochip0:7"));
    assert_null(strstr(text, "gpiochip1")); /* a link */
    assert_int_equal(gpio_find(&place, "D/C", "TWICE"), HAL_ERR_ARG);
    assert_int_equal(m.chips_open, 0);
}

/* ---- Sending ------------------------------------------------------------------------------------------------- */

static void bytes_random(uint8_t *to, size_t n, uint64_t seed)
{
    struct prng p = { seed };
    for (size_t i = 0; i < n; i++)
        to[i] = (uint8_t)prng_pick(&p, 256);
}

/* A picture in strips through this HAL and, beside it, through the simulator's bus: both models show the same. */
static void picture_both_ways(const char *name, int rotate, const char *bufsiz, uint32_t limit)
{
    static _Alignas(4) uint8_t px[320 * 16 * 2], scratch[320 * 16 * 2];
    static uint8_t ours[240 * 320 * 3], truth[240 * 320 * 3];
    struct sim_panel_wish wish = { name, rotate, 0, 0, 1 };
    struct sim_panel_frame simulated;
    struct panel panel;
    machine();
    m.bufsiz = bufsiz;
    m.limit = limit;
    model_of(name);
    open_as(&all_wired);
    assert_int_equal(sim_panel_begin(&simulated, &wish, name, 16), 0);
    assert_int_equal(panel_init(&panel, &simulated.panel.config, hal_bus(), scratch, sizeof scratch), HAL_ERR_NONE);
    for (uint16_t y = 0; y < panel_height(&panel); y = (uint16_t)(y + 16)) {
        const uint16_t rows = panel_height(&panel) - y;
        const struct panel_rect rect = { 0, y, panel_width(&panel), rows < 16 ? rows : 16 };
        bytes_random(px, sizeof px, y + 1u);
        assert_int_equal(panel_send(&panel, &rect, px, 0), HAL_ERR_NONE);
        assert_int_equal(panel_wait(&panel), HAL_ERR_NONE);
        assert_int_equal(panel_send(&simulated.panel, &rect, px, 0), HAL_ERR_NONE);
        assert_int_equal(panel_wait(&simulated.panel), HAL_ERR_NONE);
    }
    const struct pm_problem *problem;
    if (pm_problems(m.model, &problem) > 0)
        fail_msg("%s: %s", name, problem[0].text);
    pm_picture(m.model, ours, NULL);
    pm_picture(simulated.model, truth, NULL);
    assert_int_equal(pm_counts(m.model)->resets, 1);
    assert_true(m.chip[0].line[5].level);
    assert_memory_equal(ours, truth, sizeof ours);
    assert_int_equal(pm_counts(m.model)->bytes, pm_counts(simulated.model)->bytes);
    assert_int_equal(linux_sent().bytes, pm_counts(m.model)->bytes);
    sim_panel_free(&simulated);
    expect_shut();
}

static void pictures_are_the_simulators(void **state)
{
    for (int rotate = 0; rotate < 4; rotate++) {
        picture_both_ways("st7789:135x240", rotate, "4096\n", 4096);
        picture_both_ways("ssd0323:128x64", rotate, "4096\n", 4096);
        picture_both_ways("ssd1306:128x64", rotate, "4096\n", 4096);
    }
    picture_both_ways("ili9341:240x320", 1, "65536\n", 65536);
    picture_both_ways("ssd1351:128x128", 3, "7\n", 7);
    picture_both_ways("gc9a01:240x240", 0, "1001\n", 1001);
    picture_both_ways("ssd1306:72x40", 2, "1\n", 1);
    picture_both_ways("st7789:240x240", 0, NULL, 4096);
    picture_both_ways("st7789:240x240", 0, "nonsense", 4096);
    picture_both_ways("st7789:240x240", 0, "0", 4096);
}

/* A command is a byte and its arguments; data is cut at bufsiz, none of it copied. */
static void messages(void **state)
{
    static const uint32_t limits[] = { 1, 7, 64, 4096, 65536 }, sizes[] = { 1, 6, 7, 8, 4095, 4096, 4097, 11520 };
    static _Alignas(4) uint8_t px[11520];
    const uint8_t args[4] = { 1, 2, 3, 4 };
    for (size_t i = 0; i < sizeof limits / sizeof limits[0]; i++)
        for (size_t k = 0; k < sizeof sizes / sizeof sizes[0]; k++) {
            char text[16];
            machine();
            (void)snprintf(text, sizeof text, "%u\n", (unsigned)limits[i]);
            m.bufsiz = text;
            m.limit = limits[i];
            open_as(&all_wired);
            struct hal_bus *bus = hal_bus();
            assert_int_equal(bus->command(bus, 0x2a, args, 4), HAL_ERR_NONE);
            assert_int_equal(bus->command(bus, 0x2c, NULL, 0), HAL_ERR_NONE);
            const uint32_t before = m.n_sent;
            assert_int_equal(bus->data(bus, px, sizes[k]), HAL_ERR_NONE);
            assert_int_equal(bus->wait(bus), HAL_ERR_NONE);
            assert_int_equal(before, 2u + (4u + limits[i] - 1u) / limits[i]);
            assert_int_equal(m.n_sent - before, (sizes[k] + limits[i] - 1u) / limits[i]);
            uint32_t at = 0;
            for (uint32_t j = before; j < m.n_sent; j++) {
                assert_true(m.sent[j].at == px + at);
                assert_true(m.sent[j].dc);
                assert_int_equal(m.sent[j].n, sizes[k] - at < limits[i] ? sizes[k] - at : limits[i]);
                at += m.sent[j].n;
            }
            assert_int_equal(at, sizes[k]);
            assert_true(m.sent[0].n == 1 && !m.sent[0].dc && m.sent[1].dc && !m.sent[before - 1].dc);
            assert_int_equal(linux_sent().messages, m.n_sent);
            expect_shut();
        }
}

/* Data goes out by itself: data returns while the first message is held up, and all that the contract says of the time
 * until wait holds. */
struct counted {
    sem_t begun, go;
    pthread_t caller;
    int idle, done, done_elsewhere;
};

static void on_idle(void *ctx)
{
    struct counted *c = ctx;
    if (c->idle++ == 3)
        (void)sem_post(&c->go);
}

static void on_done(void *ctx)
{
    struct counted *c = ctx;
    c->done++;
    c->done_elsewhere += !pthread_equal(c->caller, pthread_self());
}

static void data_leaves_while_the_caller_goes_on(void **state)
{
    static uint8_t px[64];
    struct counted c = { .caller = pthread_self() };
    struct hal_bus *bus = hal_bus();
    machine();
    assert_int_equal(sem_init(&c.begun, 0, 0) | sem_init(&c.go, 0, 0), 0);
    m.begun = &c.begun;
    m.go = &c.go;
    open_as(&all_wired);
    bus->hooks = (struct hal_hooks){ &c, on_idle, on_done, NULL, NULL };
    assert_int_equal(bus->data(bus, px, sizeof px), HAL_ERR_NONE);
    (void)sem_wait(&c.begun);
    assert_int_equal(c.done, 0);
    assert_int_equal(bus->data(bus, px, sizeof px), HAL_ERR_STATE);
    assert_int_equal(bus->command(bus, 0x2c, NULL, 0), HAL_ERR_STATE);
    assert_int_equal(bus->reset(bus), HAL_ERR_STATE);
    assert_int_equal(bus->wait(bus), HAL_ERR_NONE); /* idle lets it go */
    assert_true(c.idle >= 4);
    assert_int_equal(c.done, 1);
    assert_int_equal(c.done_elsewhere, 1);
    assert_int_equal(bus->wait(bus), HAL_ERR_NONE);
    bus->hooks.idle = NULL;
    (void)sem_post(&c.go);
    assert_int_equal(bus->data(bus, px, sizeof px), HAL_ERR_NONE);
    assert_int_equal(bus->wait(bus), HAL_ERR_NONE);
    assert_int_equal(c.done, 2);
    assert_int_equal(bus->data(bus, NULL, 2), HAL_ERR_ARG);
    assert_int_equal(bus->data(bus, px, 0), HAL_ERR_ARG);
    assert_int_equal(bus->command(bus, 0, NULL, 1), HAL_ERR_ARG);
    (void)sem_post(&c.go);
    assert_int_equal(bus->data(bus, px, sizeof px), HAL_ERR_NONE);
    linux_close(); /* waits for it */
    assert_int_equal(c.done, 3);
    bus->hooks = (struct hal_hooks){ 0 };
    expect_shut();
}

static void failed_messages(void **state)
{
    static const struct {
        int why, err;
        const char *words;
    } t[] = { { EIO, HAL_ERR_BUS, "dmesg" }, { ETIMEDOUT, HAL_ERR_TIMEOUT, "another speed" },
              { ESHUTDOWN, HAL_ERR_BUS, "is gone" }, { EINVAL, HAL_ERR_BUS, "another speed" } };
    static uint8_t px[9000];
    struct hal_bus *bus = hal_bus();
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++) {
        machine();
        open_as(&all_wired);
        m.bad_from = 1;
        m.bad_to = 2;
        m.bad_errno = t[i].why;
        assert_int_equal(bus->data(bus, px, sizeof px), HAL_ERR_NONE);
        assert_int_equal(bus->wait(bus), t[i].err);
        assert_int_equal(m.n_sent, 2); /* the third was not tried */
        assert_non_null(strstr(linux_why(), t[i].words));
        assert_int_equal(bus->data(bus, px, sizeof px), HAL_ERR_NONE);
        assert_int_equal(bus->wait(bus), HAL_ERR_NONE);
        m.interrupts = 3;
        assert_int_equal(bus->command(bus, 1, px, 2), HAL_ERR_NONE);
        assert_int_equal(m.n_sent, 2 + 3 + 2);
        m.bad_from = m.n_sent + 1;
        m.bad_to = m.n_sent + 2;
        assert_int_equal(bus->command(bus, 1, px, 2), t[i].err);
        expect_shut();
    }
}

static void edges(void **state)
{
    machine();
    open_as(&all_wired);
    m.edges_before = 5;
    assert_int_equal(linux_wait_edge(10), 0); /* those before do not count */
    assert_int_equal(m.edges_before, 0);
    m.edges = 1;
    assert_int_equal(linux_wait_edge(10), 1);
    assert_int_equal(linux_wait_edge(10), 0);
    m.edge_errno = EINTR;
    assert_int_equal(linux_wait_edge(10), 0);
    m.edge_errno = ENODEV;
    assert_int_equal(linux_wait_edge(10), HAL_ERR_BUS);
    assert_non_null(strstr(linux_why(), "TE: "));
    assert_non_null(strstr(linux_why(), "load its chip's driver"));
    m.edge_errno = 0;
    expect_shut();
}

/* ---- The program --------------------------------------------------------------------------------------------- */

int zstrip_linux(int argc, char **argv); /* main of sim/linux/main.c */

/* What a run of it left behind. */
struct left {
    uint8_t rgb[240 * 320 * 3]; /* what was seen last before the panel went dark */
    int n_lit, still_lit, held, light, lights, requests;
    uint64_t pixel_bytes, slept_us;
    uint32_t n_sent;
    char problem[160];
};
static struct left *left;
static char said[16384]; /* stdout and stderr */

static void child(const char *line)
{
    char text[512], *argv[40] = { "zstrip-linux" };
    int argc = 1;
    const struct pm_problem *problem;
    (void)snprintf(text, sizeof text, "%s", line);
    for (char *word = strtok(text, " "); word && argc < 39; word = strtok(NULL, " "))
        argv[argc++] = word;
    m.lit = left->rgb;
    (void)signal(SIGHUP, m.no_hup ? SIG_IGN : SIG_DFL); /* the tests may be run by nohup themselves */
    (void)alarm(20); /* seconds: it ends, or it is a failure */
    const int status = zstrip_linux(argc, argv);
    left->n_lit = m.n_lit;
    left->held = held_lines();
    left->light = m.chip[0].line[6].level || m.light_on; /* glass that goes blank is not to be seen */
    left->lights = m.lights;
    left->requests = m.requests;
    left->n_sent = m.n_sent;
    left->slept_us = m.slept_us;
    if (m.model) {
        left->still_lit = pm_lit(m.model);
        left->pixel_bytes = pm_counts(m.model)->pixel_bytes;
        if (pm_problems(m.model, &problem) > 0)
            memcpy(left->problem, problem[0].text, sizeof left->problem);
        pm_free(m.model);
        m.model = NULL;
    }
    exit(status);
}

/* Run it with these arguments on the machine as it is. Its exit status; -1: it died. */
static int run(const char *line)
{
    const int out = memfd_create("said", 0);
    int status;
    memset(left, 0, sizeof *left);
    (void)fflush(stdout);
    (void)fflush(stderr);
    const pid_t pid = fork();
    if (pid == 0) {
        (void)dup2(out, 1);
        (void)dup2(out, 2);
        child(line);
    }
    assert_int_equal(waitpid(pid, &status, 0), pid);
    const ssize_t n = pread(out, said, sizeof said - 1, 0);
    said[n > 0 ? n : 0] = '\0';
    (void)close(out);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

#define WIRED "--spi /dev/spidev0.0 --dc DC --reset RST --backlight LIGHT "

static void expect_dark(int status)
{
    if (status != 0)
        fail_msg("status %d: %s", status, said);
    if (!m.bad_to) /* else half a message is one */
        assert_string_equal(left->problem, "");
    assert_int_equal(left->still_lit, 0);
    assert_int_equal(left->light, 0);
    assert_int_equal(left->held, 0);
}

/* What the simulator shows of frame t. */
static void truth_of(uint8_t *rgb, const char *panel, int turns, const struct demo *demo, uint32_t t)
{
    struct sim_panel_wish wish = { panel, turns, 0, 0, 1 };
    struct sim_panel_frame p;
    struct zs_renderer r;
    struct demo_frame f;
    assert_int_equal(sim_panel_begin(&p, &wish, panel, 8), 0);
    const uint16_t w = panel_width(&p.panel), h = panel_height(&p.panel);
    const struct zs_config config = { .width = w, .height = h, .strip_h = 8, .max_tris = ZS_POOL_MAX,
                                      .max_verts = ZS_POOL_MAX, .varyings = (uint8_t)demo->varyings, .buffers = 1,
                                      .subpixel_bits = 8, .depth_bits = 16, .depth = demo->depth, .fast = demo->fast };
    void *arena = malloc(zs_arena_bytes(&config));
    assert_int_equal(zs_init(&r, &config, arena, zs_arena_bytes(&config)), ZS_OK);
    demo->pose(&f, t, w, h);
    const struct zs_sink sink = sim_panel_sink(&p);
    assert_int_equal(zs_render(&r, &f.scene, &f.camera, &sink), ZS_OK);
    pm_picture(p.model, rgb, NULL);
    free(arena);
    sim_panel_free(&p);
}

static void program_draws_what_the_simulator_draws(void **state)
{
    static const struct {
        const char *panel;
        int turns;
        const struct demo *demo;
        uint32_t frames, step;
        const char *more;
    } t[] = { { "st7789:240x240", 0, &demo_teapot, 1, 1, "" },
              { "st7789:135x240", 1, &demo_cubes, 3, 7, "" },
              { "ili9341:240x320", 3, &demo_city, 2, 30, "--partial --strip 7" },
              { "ssd1306:128x64", 1, &demo_knot, 4, 5, "--partial --strip 16" },
              { "ssd0323:128x64", 1, &demo_cubes, 4, 3, "--partial --strip 10" },
              { "ssd1306:72x40", 1, &demo_cubes, 6, 3, "--partial" }, /* columns that are no whole pages */
              { "ssd1306:72x40", 3, &demo_globe, 6, 3, "--partial" },
              { "ssd1306:72x40", 1, &demo_teapot, 6, 1, "--partial" },
              { "ssd1306:64x48", 1, &demo_knot, 6, 1, "--partial" },
              { "ssd0323:128x64", 2, &demo_globe, 2, 3, "--te TEAR" },
              { "st7789:240x240", 0, &demo_cubes, 5, 2, "--partial --te TEAR --strip 1" } };
    static uint8_t truth[240 * 320 * 3];
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++) {
        char line[512];
        (void)snprintf(line, sizeof line, WIRED "--panel %s --rotate %d --scene %s --frames %u --step %u --stats %s",
                       t[i].panel, 90 * t[i].turns, t[i].demo->name, t[i].frames, t[i].step, t[i].more);
        machine();
        model_of(t[i].panel);
        m.edges = 99;
        expect_dark(run(line));
        memset(truth, 0, sizeof truth);
        truth_of(truth, t[i].panel, t[i].turns, t[i].demo, (t[i].frames - 1) * t[i].step);
        if (left->n_lit == 0 || memcmp(left->rgb, truth, sizeof truth) != 0)
            fail_msg("another picture: %s", line);
        if (strstr(t[i].more, "--te TEAR"))
            assert_true(left->slept_us >= 1000000u * t[i].frames);
        assert_non_null(strstr(said, "scene,frames,frames/s,draw us,wire us,hidden %"));
    }
}

/* --model on a glass of 240x240: frame t, of which --frames shows the last. */
static void model_seen(uint32_t t, const char *path)
{
    char line[512];
    (void)snprintf(line, sizeof line, WIRED "--panel st7789:240x240 --model %s --frames 2 --step %u", path, t);
    model_of("st7789:240x240");
    expect_dark(run(line));
}

/* A box that lies elsewhere than about the world's middle: frame 0 is what `zsim render` draws; it turns about its own
 * middle, so that a quarter of a turn shows the same. */
static void program_turns_a_model(void **state)
{
    static const char box[] =
        "v 5 1 8\nv 7 1 8\nv 7 4 8\nv 5 4 8\nv 5 1 6\nv 7 1 6\nv 7 4 6\nv 5 4 6\n"
        "f 1 2 3 4\nf 6 5 8 7\nf 5 1 4 8\nf 2 6 7 3\nf 4 3 7 8\nf 5 6 2 1\n";
    static uint8_t first[240 * 240 * 3];
    char path[64], line[512];
    uint32_t other = 0, lit = 0;
    machine();
    (void)snprintf(path, sizeof path, "%s/box.obj", folder);
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    assert_true(fputs(box, f) >= 0 && fclose(f) == 0);
    model_seen(0, path);
    memcpy(first, left->rgb, sizeof first);
    (void)snprintf(line, sizeof line, "%s/ours.png", folder);
    assert_int_equal(sim_png_save(line, 240, 240, first), 0);
    (void)snprintf(line, sizeof line, "%.*s/zsim render %s --panel st7789:240x240 --subpixel 8 --out "
                   "%s/truth.png >/dev/null && cmp %s/ours.png %s/truth.png",
                   (int)(strrchr(cases_program, '/') - cases_program), cases_program, path, folder, folder, folder);
    assert_int_equal(system(line), 0);
    model_seen(64, path);
    for (uint32_t i = 0; i < sizeof first; i++) {
        lit += first[i] != first[0];
        other += abs(first[i] - left->rgb[i]) > 16;
    }
    assert_in_range(lit, sizeof first / 20, sizeof first);
    assert_in_range(other, 0, sizeof first / 200);
    model_seen(32, path);
    assert_memory_not_equal(first, left->rgb, sizeof first);
}

/* Messages of a picture: 10 strips of 11520 bytes are three each, behind five of the window; the glass is cleared by as
 * many, behind one window. Set-up's and sleep's commands besides. */
static void program_sends_few_messages(void **state)
{
    machine();
    model_of("st7789:240x240");
    expect_dark(run(WIRED "--panel st7789:240x240 --scene cubes --frames 1 --stats"));
    assert_non_null(strstr(said, ",115310,80\n"));
    assert_in_range(left->n_sent, 80 + 35, 80 + 35 + 60);
}

/* Frames that are alike travel once. */
static void partial_saves_bytes(void **state)
{
    static const char line[] = WIRED "--panel st7789:240x240 --scene cubes --frames 3 --step 0";
    char partial[512];
    machine();
    model_of("st7789:240x240");
    expect_dark(run(line));
    assert_int_equal(left->pixel_bytes, 4u * 240 * 240 * 2);
    (void)snprintf(partial, sizeof partial, "%s --partial", line);
    machine();
    model_of("st7789:240x240");
    expect_dark(run(partial));
    assert_int_equal(left->pixel_bytes, 2u * 240 * 240 * 2);
}

/* SIGTERM in whatever message: the panel ends dark and asleep, status 0. */
static void signals_at_any_moment(void **state)
{
    for (uint32_t at = 1; at < 400; at += at < 40 ? 1 : 37) {
        machine();
        model_of("ssd1306:128x64");
        m.signal_at = at;
        expect_dark(run(WIRED "--panel ssd1306:128x64 --scene cubes --strip 16"));
        assert_true(left->n_sent <= (at < 35 ? 41 : at + 14)); /* the rest of set-up, or of a strip; sleep */
    }
    machine();
    model_of("st7789:135x240");
    m.signal_at = 150; /* in set-up: while it is cleared */
    expect_dark(run(WIRED "--panel st7789:135x240 --scene cubes --strip 1"));
    assert_int_equal(left->pixel_bytes, 135 * 240 * 2);
    machine();
    model_of("ssd1306:128x64");
    m.edge_signal = 1; /* in the wait for the first frame's edge */
    expect_dark(run(WIRED "--te TEAR --panel ssd1306:128x64 --scene cubes"));
    assert_int_equal(left->pixel_bytes, 1024);
    assert_string_equal(said, "");
    for (int no_hup = 0; no_hup < 2; no_hup++) {
        machine();
        model_of("ssd1306:128x64");
        m.signal = SIGHUP;
        m.signal_at = 45; /* in the first frame */
        m.no_hup = no_hup;
        expect_dark(run(WIRED "--panel ssd1306:128x64 --scene cubes --frames 3"));
        assert_int_equal(left->lights, no_hup);
        assert_int_equal(left->pixel_bytes == 4u * 1024u, no_hup);
    }
}

/* With a wire that takes as long as drawing, that goes on behind it, for all strips of a frame but the first; sent and
 * drawn by turns, none would. */
static void drawing_hides_behind_the_wire(void **state)
{
    unsigned long frames, draw, wire, hidden;
    double rate;
    machine();
    m.draw_us = 5000;
    m.wire_hz = 15000000;
    expect_dark(run(WIRED "--panel st7789:240x240 --scene cubes --frames 4 --strip 24 --stats"));
    const char *at = strstr(said, "cubes,");
    assert_non_null(at);
    assert_int_equal(sscanf(at, "cubes,%lu,%lf,%lu,%lu,%lu", &frames, &rate, &draw, &wire, &hidden), 5);
    print_message("%lu frames: %.1f frames/s, draw %lu us, wire %lu us, hidden %lu %%\n", frames, rate, draw, wire,
                  hidden);
    assert_int_equal(frames, 4);
    assert_true(wire >= 61440); /* 115200 bytes at 15 MHz */
    assert_in_range(hidden, 25, 90);
}

/* Of three frames that were asked for, or of those for ever, the first is not taken. */
static void program_goes_on_after_failures(void **state)
{
    static uint8_t truth[240 * 320 * 3];
    static const char line[] = WIRED "--panel ssd1306:128x64 --scene cubes";
    char frames[256];
    truth_of(truth, "ssd1306:128x64", 0, &demo_cubes, 2);
    machine();
    model_of("ssd1306:128x64");
    m.bad_from = 45; /* in the first frame */
    m.bad_to = 46;
    m.bad_errno = EIO;
    (void)snprintf(frames, sizeof frames, "%s --frames 3", line);
    assert_int_equal(run(frames), 1); /* all were asked for */
    expect_dark(0);
    assert_non_null(strstr(said, "frame 0: /dev/spidev0.0: "));
    assert_null(strstr(said, "frame 1"));
    assert_memory_equal(left->rgb, truth, 128 * 64 * 3);
    assert_int_equal(left->lights, 1);
    m.signal_at = 400;
    expect_dark(run(line));
    assert_non_null(strstr(said, "frame 0: /dev/spidev0.0: "));
    assert_int_equal(left->lights, 1);
}

/* A panel that takes nothing from some message on: status 1, and the light was never on without a picture. */
static void program_gives_up(void **state)
{
    static const struct {
        uint32_t from;
        const char *frames, *words;
        int lights;
    } t[] = { { 0, "", "the panel cannot be set up: /dev/spidev0.0: 1 bytes were not sent", 0 },
              { 45, "--frames 1", "frame 0: /dev/spidev0.0: ", 0 },
              { 45, "", "frame ", 0 },
              { 90, "", "frame ", 1 } };
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++) {
        char line[256];
        (void)snprintf(line, sizeof line, WIRED "--panel ssd1306:128x64 --scene cubes %s", t[i].frames);
        machine();
        model_of("ssd1306:128x64");
        m.bad_from = t[i].from;
        m.bad_to = UINT32_MAX;
        m.bad_errno = EIO;
        assert_int_equal(run(line), 1);
        if (!strstr(said, t[i].words) || left->lights != t[i].lights)
            fail_msg("row %zu: light on %d times, %s", i, left->lights, said);
        assert_int_equal(strstr(said, "cannot be put to sleep") != NULL, i > 0);
        assert_int_equal(left->held, 0);
        assert_int_equal(left->light, 0);
    }
}

/* Only the last commands are not taken: the picture was shown, but the panel is not asleep. */
static void panel_that_does_not_sleep(void **state)
{
    static const char line[] = WIRED "--panel ssd1306:128x64 --scene cubes --frames 1";
    machine();
    model_of("ssd1306:128x64");
    expect_dark(run(line));
    m.bad_from = left->n_sent - 1;
    m.bad_to = UINT32_MAX;
    m.bad_errno = EIO;
    assert_int_equal(run(line), 1);
    assert_non_null(strstr(said, "the panel cannot be put to sleep: /dev/spidev0.0: "));
    assert_int_equal(left->held, 0);
    assert_int_equal(left->light, 0);
}

static void no_edge_comes(void **state)
{
    machine();
    model_of("ssd1306:128x64");
    m.edges = 2;
    expect_dark(run(WIRED "--te TEAR --panel ssd1306:128x64 --scene cubes --frames 5"));
    assert_non_null(strstr(said, "--te TEAR: no edge came for 1000 ms"));
    assert_true(left->slept_us >= 3000000u && left->slept_us < 3900000u); /* two came, one did not, then no more */
}

static void command_lines(void **state)
{
    static const struct {
        const char *line;
        int status;
        const char *words;
    } t[] = {
        { "--help", 0, "usage: zstrip-linux" },
        { "", 2, "--panel is missing" },
        { "--panel st7789:240x240 --dc DC --scene cubes", 2, "--spi is missing" },
        { "--panel st7789:240x240 --spi /dev/spidev0.0 --scene cubes", 2, "--dc is missing" },
        { WIRED "--panel st7789:240x240", 2, "--scene or --model" },
        { WIRED "--panel st7789:240x240 --scene cubes --model a.obj", 2, "either --scene or --model" },
        { WIRED "--panel st7789:240x240 --scene cubes --step 2", 2, "--step is for --frames" },
        { WIRED "--panel st7789:240x240 --scene cubes --what", 2, "unknown option '--what'" },
        { WIRED "--panel st7789:240x240 --scene cubes --rotate 45", 2, "0|90|180|270" },
        { WIRED "--panel st7789:240x240 --scene cubes --speed 10", 1, "--speed 10 is outside" },
        { WIRED "--panel st7788:240x240 --scene cubes", 1, "there are st7789:240x240" },
        { WIRED "--panel st7789:240x240 --scene cubist", 1, "no such scene" },
        { WIRED "--panel ssd1306:128x64 --scene cubes --strip 5", 1, "multiple" },
        { WIRED "--panel st7789:240x240 --scene cubes --te NOPE", 1, "held by spi0 CS0" },
        { WIRED "--panel st7789:240x240 --scene cubes --te CE0", 1, "stop that program" },
        { WIRED "--panel st7789:240x240 --scene cubes --dry-run", 0, "/dev/gpiochip0:4 [pinctrl-test] DC, free" },
        { WIRED "--panel st7789:240x240 --scene cubes --dry-run", 0, "32000000 Hz, messages of up to 4096 bytes" },
        { WIRED "--panel st7789:240x240 --scene cubes --dry-run", 0, "115200 bytes of pixels a frame, 28800 us" },
        { WIRED "--panel ssd1306:128x64 --scene cubes --dry-run", 0, "1024 bytes of pixels a frame, 819 us" },
        { WIRED "--panel st7789:240x240 --scene cubes --te CE0 --dry-run", 1, "CE0, held by spi0 CS0" },
        { WIRED "--panel st7789:240x240 --scene cubes --te CE0 --dry-run", 1, "TE: line /dev/gpiochip0:2, CE0 is" },
        { WIRED "--panel st7789:240x240 --scene cubes --te NOPE --dry-run", 1, "gpiochip2:7" },
    };
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++) {
        machine();
        const int status = run(t[i].line);
        if (status != t[i].status || !strstr(said, t[i].words))
            fail_msg("'%s': status %d, %s", t[i].line, status, said);
        assert_int_equal(left->requests == 0 || strstr(t[i].words, "stop that") != NULL, 1);
        assert_int_equal(left->n_sent, 0);
        assert_int_equal(left->held, 0);
    }
}

static int begin(void **state)
{
    left = mmap(NULL, sizeof *left, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return left == MAP_FAILED || mkdtemp(folder) == NULL;
}

static int end(void **state)
{
    pm_free(m.model);
    return remove_folder();
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(lines_are_held_from_first_to_last),
    cmocka_unit_test(lines_by_name_label_and_number),
    cmocka_unit_test(refusals),
    cmocka_unit_test(names_of_devices),
    cmocka_unit_test(pictures_are_the_simulators),
    cmocka_unit_test(messages),
    cmocka_unit_test(data_leaves_while_the_caller_goes_on),
    cmocka_unit_test(failed_messages),
    cmocka_unit_test(edges),
    cmocka_unit_test(program_draws_what_the_simulator_draws),
    cmocka_unit_test(program_turns_a_model),
    cmocka_unit_test(program_sends_few_messages),
    cmocka_unit_test(partial_saves_bytes),
    cmocka_unit_test(signals_at_any_moment),
    cmocka_unit_test(drawing_hides_behind_the_wire),
    cmocka_unit_test(program_goes_on_after_failures),
    cmocka_unit_test(program_gives_up),
    cmocka_unit_test(panel_that_does_not_sleep),
    cmocka_unit_test(no_edge_comes),
    cmocka_unit_test(command_lines)
};

int main(int argc, char **argv)
{
    cases_program = argv[0];
    if (argc > 1)
        cmocka_set_test_filter(argv[1]);
    (void)alarm(120);
    return cmocka_run_group_tests(tests, begin, end);
}
