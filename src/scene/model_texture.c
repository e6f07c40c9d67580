/* SPDX-License-Identifier: MIT
 *
 * Textures from PNG and JPEG files, and from the bytes of one inside a mesh's file.
 */
#include <spng.h>
#include <stdlib.h>
#include <string.h>
#include <turbojpeg.h>

#include "base/pixel_budget.h"
#include "base/regular_file.h"
#include "scene/model.h"
#include "scene/scene_text.h"

enum { TEXTURE_SIDE = 16384, TEXTURE_BYTES = 512 * 1024 * 1024 };

static bool refuse(model_fault *fault, const char *name, const char *what)
{
    return model_fault_set(fault, SCENE_ERROR_BAD_SCENE, "%s: %s; allowed: a PNG or JPEG picture of at most %d x %d pixels", scene_file_name(name).text, what,
                           TEXTURE_SIDE, TEXTURE_SIDE);
}

/* Before any of them is decoded. */
static bool is_within_budget(uint64_t width, uint64_t height, const char *name, const uint64_t *pixels, model_fault *fault)
{
    const uint64_t own = width * height, all = *pixels + own;
    return all <= pixel_budget() ||
           model_fault_set(fault, SCENE_ERROR_BAD_SCENE, "%s: with its %llu pixels the scene's textures have %llu; %s", scene_file_name(name).text,
                           (unsigned long long)own, (unsigned long long)all, pixel_budget_allowed(all).text);
}

/* RGBA, 8 bits each. */
typedef struct decoded {
    uint8_t *pixels; /* owned; NULL: the fault says why */
    uint32_t width, height;
} decoded;

static const char *png_problem(int code)
{
    return code == SPNG_IO_EOF ? "is not a sound PNG: it ends too early" : code == SPNG_ESIGNATURE ? "is neither PNG nor JPEG" : spng_strerror(code);
}

static decoded decode_png(const void *bytes, size_t length, const char *name, const uint64_t *pixels, model_fault *fault)
{
    decoded out = {0};
    struct spng_ihdr header = {0};
    size_t size = 0;
    spng_ctx *context = spng_ctx_new(0);
    if (context == NULL || spng_set_image_limits(context, TEXTURE_SIDE, TEXTURE_SIDE) != 0 ||
        spng_set_chunk_limits(context, (size_t)16 << 20, (size_t)64 << 20) != 0 || spng_set_png_buffer(context, bytes, length) != 0) {
        model_fault_memory(fault);
        goto done;
    }
    int code = spng_get_ihdr(context, &header);
    if (!code)
        code = spng_decoded_image_size(context, SPNG_FMT_RGBA8, &size);
    if (!code && !is_within_budget(header.width, header.height, name, pixels, fault))
        goto done;
    out = (decoded){.pixels = code ? NULL : malloc(size), .width = header.width, .height = header.height};
    if (!code && out.pixels == NULL)
        code = SPNG_EMEM;
    if (!code)
        code = spng_decode_image(context, out.pixels, size, SPNG_FMT_RGBA8, 0);
    if (!code)
        code = spng_decode_chunks(context); /* the checksum of what was decoded, and what follows */
    if (!code)
        goto done;
    free(out.pixels);
    out.pixels = NULL;
    if (code == SPNG_EMEM)
        model_fault_memory(fault);
    else
        refuse(fault, name, png_problem(code));
done:
    spng_ctx_free(context);
    return out;
}

static decoded decode_jpeg(const void *bytes, size_t length, const char *name, const uint64_t *pixels, model_fault *fault)
{
    decoded out = {0};
    int width = 0, height = 0, sampling, space;
    tjhandle handle = tjInitDecompress();
    if (handle == NULL) {
        model_fault_memory(fault);
        return out;
    }
    bool good = tjDecompressHeader3(handle, bytes, length, &width, &height, &sampling, &space) == 0 && width > 0 && height > 0;
    if (good && (width > TEXTURE_SIDE || height > TEXTURE_SIDE)) {
        refuse(fault, name, "is too large");
        goto done;
    }
    if (good && !is_within_budget((uint64_t)width, (uint64_t)height, name, pixels, fault))
        goto done;
    out = (decoded){.pixels = good ? malloc((size_t)width * (size_t)height * 4) : NULL, .width = (uint32_t)width, .height = (uint32_t)height};
    if (good && out.pixels == NULL) {
        model_fault_memory(fault);
        goto done;
    }
    good = good && tjDecompress2(handle, bytes, length, out.pixels, width, 0, height, TJPF_RGBA, TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING) == 0;
    if (!good) {
        refuse(fault, name, "is not a sound JPEG");
        free(out.pixels);
        out.pixels = NULL;
    }
done:
    tjDestroy(handle);
    return out;
}

mgt_texture *texture_parse(const void *bytes, size_t length, const char *name, uint64_t *pixels, uint64_t *hash, model_fault *fault)
{
    mgt_texture *texture = NULL;
    mgt_texture_desc desc;
    mgt_texture_desc_init(&desc, sizeof desc);
    const bool is_jpeg = length > 3 && memcmp(bytes, "\xff\xd8\xff", 3) == 0;
    const decoded picture = is_jpeg ? decode_jpeg(bytes, length, name, pixels, fault) : decode_png(bytes, length, name, pixels, fault);
    if (picture.pixels == NULL)
        return NULL;
    desc.width = picture.width;
    desc.height = picture.height;
    desc.pixels = picture.pixels;
    *pixels += (uint64_t)picture.width * picture.height;
    *hash = model_hash(picture.width, picture.pixels, (size_t)picture.width * picture.height * 4);
    const mgt_status status = mgt_texture_create(&texture, &desc);
    if (status == MGT_ERROR_MEMORY)
        model_fault_memory(fault);
    else if (status != MGT_OK)
        refuse(fault, name, mgt_last_error(NULL));
    free(picture.pixels);
    return texture;
}

mgt_texture *texture_load(const char *path, uint64_t *pixels, uint64_t *hash, model_fault *fault)
{
    regular_file read;
    size_t length = 0;
    char *bytes = regular_file_read(&read, path, false, TEXTURE_BYTES, "is larger than 512 MiB", &length);
    if (bytes == NULL) {
        refuse(fault, path, read.what);
        fault->kind = scene_error_of_fault(read.fault);
        return NULL;
    }
    mgt_texture *texture = texture_parse(bytes, length, path, pixels, hash, fault);
    free(bytes);
    return texture;
}
