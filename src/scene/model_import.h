/* SPDX-License-Identifier: MIT
 *
 * Runs mangata-import, the program that reads glTF and OBJ files.
 */
#ifndef MANGATA_SCENE_MODEL_IMPORT_H
#define MANGATA_SCENE_MODEL_IMPORT_H

#include "scene/model.h"

/* The program's output in the format of model_wire.h. Only its header has been checked. */
typedef struct model_import {
    const char *bytes; /* mapped memory */
    size_t length;
} model_import;

/* Reads the file at `path` in a process of its own. `weight`: size of the file and of the files that it refers to, bytes. The process may use memory of 256 MiB
 * plus 160 times `weight`, and processor time of 4 s plus 2 s per MiB of `weight`. It ends with the calling thread, however that ends. Any thread may call,
 * also in a host with threads of its own, and in a host that ignores SIGCHLD or waits for all children. The program is searched beside the library and
 * beside the calling program, where an installation has it from there, and in the place of its installation. Without it the file is refused. False: *fault
 * is filled. True: call model_import_end(). */
bool model_import_run(model_import *out, const char *path, uint64_t weight, model_fault *fault);
void model_import_end(model_import *import);

#endif
