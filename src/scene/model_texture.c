/* SPDX-License-Identifier: MIT
 *
 * Textures from PNG files, and from the bytes of one inside a mesh's file.
 */
#include <errno.h>
#include <spng.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "scene/model.h"

enum { TEXTURE_SIDE = 16384, TEXTURE_BYTES = 512 * 1024 * 1024 };

static bool refuse(model_fault *fault, const char *name, const char *what)
{
    return model_fault_set(fault, SCENE_ERROR_BAD_SCENE, "%s: %s; allowed: a PNG picture of at most %d x %d pixels", scene_file_name(name).text, what,
                           TEXTURE_SIDE, TEXTURE_SIDE);
}

/* RGBA, 8 bits each; the caller frees it. */
static uint8_t *decode(spng_ctx *context, struct spng_ihdr *header, const char *name, model_fault *fault)
{
    size_t size = 0;
    int code = spng_get_ihdr(context, header);
    if (!code)
        code = spng_decoded_image_size(context, SPNG_FMT_RGBA8, &size);
    uint8_t *pixels = code ? NULL : malloc(size);
    if (!code && pixels == NULL) {
        model_fault_memory(fault);
        return NULL;
    }
    if (!code)
        code = spng_decode_image(context, pixels, size, SPNG_FMT_RGBA8, 0);
    if (!code)
        return pixels;
    free(pixels);
    if (code == SPNG_EMEM)
        model_fault_memory(fault);
    else
        refuse(fault, name, code == SPNG_IO_EOF ? "is not a sound PNG: it ends too early" : code == SPNG_ESIGNATURE ? "is not a PNG" : spng_strerror(code));
    return NULL;
}

mgt_texture *texture_parse(const void *bytes, size_t length, const char *name, uint64_t *hash, model_fault *fault)
{
    mgt_texture *texture = NULL;
    mgt_texture_desc desc = mgt_texture_desc_defaults();
    struct spng_ihdr header;
    uint8_t *pixels = NULL;
    spng_ctx *context = spng_ctx_new(0);
    if (context == NULL || spng_set_image_limits(context, TEXTURE_SIDE, TEXTURE_SIDE) != 0 ||
        spng_set_chunk_limits(context, (size_t)16 << 20, (size_t)64 << 20) != 0 || spng_set_png_buffer(context, bytes, length) != 0) {
        model_fault_memory(fault);
        goto done;
    }
    pixels = decode(context, &header, name, fault);
    if (pixels == NULL)
        goto done;
    desc.width = header.width;
    desc.height = header.height;
    desc.pixels = pixels;
    *hash = model_hash(header.width, pixels, (size_t)header.width * header.height * 4);
    const mgt_status status = mgt_texture_create(&texture, &desc);
    if (status == MGT_ERROR_MEMORY)
        model_fault_memory(fault);
    else if (status != MGT_OK)
        refuse(fault, name, mgt_last_error(NULL));
done:
    free(pixels);
    spng_ctx_free(context);
    return texture;
}

mgt_texture *texture_load(const char *path, uint64_t *hash, model_fault *fault)
{
    struct stat status;
    mgt_texture *texture = NULL;
    void *bytes = NULL;
    /* A pipe would make opening it wait. */
    if (stat(path, &status) == 0 && !S_ISREG(status.st_mode)) {
        refuse(fault, path, "is no regular file");
        return NULL;
    }
    FILE *stream = fopen(path, "rbe");
    if (stream == NULL) {
        refuse(fault, path, strerror(errno));
        fault->kind = SCENE_ERROR_MISSING_INPUT;
        return NULL;
    }
    if (fstat(fileno(stream), &status) != 0 || status.st_size > TEXTURE_BYTES) {
        refuse(fault, path, "is larger than 512 MiB");
        goto done;
    }
    const size_t size = (size_t)status.st_size;
    bytes = malloc(size + 1);
    if (bytes == NULL)
        model_fault_memory(fault);
    else if (fread(bytes, 1, size, stream) != size)
        refuse(fault, path, "cannot be read");
    else
        texture = texture_parse(bytes, size, path, hash, fault);
done:
    free(bytes);
    fclose(stream);
    return texture;
}
