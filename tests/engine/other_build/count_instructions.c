/* A plugin of qemu-user that counts the instructions of the program that it runs, for machines whose time cannot be
 * measured under emulation:
 *
 *   cc -shared -fPIC -O2 -o count.so count_instructions.c
 *   qemu-aarch64 -plugin ./count.so,begin=0x1000,end=0x2000 PROGRAM
 *
 * It prints how many were executed, and how many of them between two addresses, which are counted from where the
 * program is loaded. What it uses of qemu's interface (version 1) is declared here: Debian has no header for it. */
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
uint64_t qemu_plugin_tb_vaddr(const struct qemu_plugin_tb* block);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* block);
uint64_t qemu_plugin_start_code(void);
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id, void (*call)(qemu_plugin_id_t, struct qemu_plugin_tb*));
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb* block, int add, void* sum, uint64_t addend);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id, void (*call)(qemu_plugin_id_t, void*), void* data);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;

static uint64_t begin, end, all, within;

static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb* block) {
  enum { kAdd = 0 };
  const uint64_t count = qemu_plugin_tb_n_insns(block), at = qemu_plugin_tb_vaddr(block) - qemu_plugin_start_code();
  (void)id;
  qemu_plugin_register_vcpu_tb_exec_inline(block, kAdd, &all, count);
  if (begin <= at && at < end) qemu_plugin_register_vcpu_tb_exec_inline(block, kAdd, &within, count);
}

static void ended(qemu_plugin_id_t id, void* data) {
  (void)id;
  (void)data;
  fprintf(stderr, "instructions: %" PRIu64 ", between the addresses: %" PRIu64 "\n", all, within);
}

__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t id, const void* info, int count,
                                                               char** arguments) {
  (void)info;
  for (int i = 0; i < count; ++i) {
    if (strncmp(arguments[i], "begin=", 6) == 0) begin = strtoull(arguments[i] + 6, NULL, 0);
    if (strncmp(arguments[i], "end=", 4) == 0) end = strtoull(arguments[i] + 4, NULL, 0);
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
  qemu_plugin_register_atexit_cb(id, ended, NULL);
  return 0;
}
