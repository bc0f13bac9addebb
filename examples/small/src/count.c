/* A QEMU plugin that counts the guest's instructions between marks, models the cycles of a Cortex-M0+, and writes
 * a line of counts at each mark of the third kind. Debian's QEMU 7.2 loads plugins but ships none. This file declares
 * the part of the plugin interface that it uses.
 *
 * Cycles are from ARM's table for the Cortex-M0+: load and store 2, each further register 1 more, a taken branch 2,
 * bl 3, muls 1, everything else 1. The model leaves out waits for flash and buses. */
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t plugin_id;
struct qemu_plugin_tb;
struct qemu_plugin_insn;
typedef struct { const char *target_name; } qemu_info;
void qemu_plugin_register_vcpu_tb_trans_cb(plugin_id, void (*)(plugin_id, struct qemu_plugin_tb *));
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *, size_t);
const void *qemu_plugin_insn_data(const struct qemu_plugin_insn *);
size_t qemu_plugin_insn_size(const struct qemu_plugin_insn *);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *, void (*)(unsigned, void *), int, void *);
void qemu_plugin_register_atexit_cb(plugin_id, void (*)(plugin_id, void *), void *);
__attribute__((visibility("default"))) int qemu_plugin_version = 1;

enum mark { NONE, START, STOP, WRITE };
typedef struct {
    uint32_t at;
    uint8_t size, mark, cycles, taken;
} instruction;

static FILE *out;
static int is_arm, is_on;
static uint64_t count, cycles;
static instruction *before;

static void execute(unsigned cpu, void *data) {
    instruction *this = data;
    /* The previous instruction was a taken branch if this one does not follow it in memory. */
    if (before && this->at != before->at + before->size)
        cycles += before->taken;
    before = 0;
    switch (this->mark) {
    case START: is_on = 1; return;
    case STOP: is_on = 0; return;
    case WRITE:
        fprintf(out, "%lu %lu\n", (unsigned long)count, (unsigned long)cycles);
        count = cycles = 0;
        return;
    }
    if (!is_on)
        return;
    count++;
    cycles += this->cycles;
    before = this;
}

static void decode_arm(instruction *this, const uint8_t *data) {
    uint16_t half = data[0] | data[1] << 8;
    this->cycles = this->taken = 1;
    switch (half) {
    case 0x46DB: this->mark = START; break;
    case 0x46D2: this->mark = STOP; break;
    case 0x46C9: this->mark = WRITE; break;
    }
    if (this->size == 4) {
        uint16_t second = data[2] | data[3] << 8;
        if ((half & 0xF800) == 0xF000 && (second & 0xD000) == 0xD000)
            this->cycles = 2; /* bl */
    } else if ((half & 0xF800) == 0x4800 || half >> 12 == 5 || half >> 13 == 3 || half >> 12 == 8 || half >> 12 == 9) {
        this->cycles = 2; /* ldr, str */
    } else if (half >> 12 == 12) {
        this->cycles = 1 + __builtin_popcount(half & 0xFF); /* ldm, stm */
    } else if ((half & 0xFE00) == 0xB400) {
        this->cycles = 1 + __builtin_popcount(half & 0x1FF); /* push */
    } else if ((half & 0xFE00) == 0xBC00) {
        this->cycles = 1 + __builtin_popcount(half & 0x1FF); /* pop */
        if (half & 0x100)
            this->taken = 2;
    }
}

static void decode_riscv(instruction *this, const uint8_t *data) {
    uint32_t word = data[0] | data[1] << 8;
    if (this->size == 4)
        word |= data[2] << 16 | (uint32_t)data[3] << 24;
    switch (word) {
    case 0x04D00013: this->mark = START; break;
    case 0x04E00013: this->mark = STOP; break;
    case 0x04F00013: this->mark = WRITE; break;
    }
}

static void translate(plugin_id id, struct qemu_plugin_tb *block) {
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); i++) {
        struct qemu_plugin_insn *of = qemu_plugin_tb_get_insn(block, i);
        instruction *this = calloc(1, sizeof *this);
        this->at = qemu_plugin_insn_vaddr(of);
        this->size = qemu_plugin_insn_size(of);
        (is_arm ? decode_arm : decode_riscv)(this, qemu_plugin_insn_data(of));
        qemu_plugin_register_vcpu_insn_exec_cb(of, execute, 0, this);
    }
}

static void end(plugin_id id, void *unused) { fclose(out); }

__attribute__((visibility("default"))) int qemu_plugin_install(plugin_id id, const qemu_info *info, int argc, char **argv) {
    const char *name = getenv("COUNTS");
    is_arm = strstr(info->target_name, "arm") != 0;
    out = fopen(name ? name : "/dev/null", "w");
    if (!out)
        return 1;
    qemu_plugin_register_vcpu_tb_trans_cb(id, translate);
    qemu_plugin_register_atexit_cb(id, end, 0);
    return 0;
}
