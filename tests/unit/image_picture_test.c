/* SPDX-License-Identifier: MIT */
/* PNG, EXR and PFM: what is written is read back, the same input gives the same bytes, and damaged files are errors. */
#include "image_test_folder.h"

#include <math.h>
#include <openexr.h>
#include <spng.h>

#include "image/cryptomatte.h"
#include "image/picture.h"

enum { WIDTH = 13, HEIGHT = 37 }; /* more than two chunks of EXR, no multiples of anything */

static const metadata_entry test_entries[] = {{"render_hash", "0123456789abcdef"},
                                              {"version", "0.1.0"},
                                              {"title", "m\xc3\xa5ngata"},
                                              {"empty", ""},
                                              {"two.lines", "a\nb"}};
static const metadata_list test_metadata = {test_entries, sizeof test_entries / sizeof *test_entries};

static void assert_metadata(const char *path)
{
    for (size_t i = 0; i < test_metadata.count; i++) {
        char *value = NULL;
        file_error error;
        assert_int_equal(metadata_read(path, test_entries[i].key, &value, &error), FILE_OK);
        if (test_entries[i].value[0] == '\0') {
            assert_null(value); /* empty is none */
            continue;
        }
        assert_non_null(value);
        assert_string_equal(value, test_entries[i].value);
        free(value);
    }
    char *value = NULL;
    assert_int_equal(metadata_read(path, "absent", &value, NULL), FILE_OK);
    assert_null(value);
}

static void fill_bytes(uint8_t *bytes, size_t size)
{
    uint32_t seed = 1;
    for (size_t i = 0; i < size; i++)
        bytes[i] = (uint8_t)test_random(&seed);
}

/* All kinds of floats: negative, tiny, huge, infinite, not a number with a payload. */
static void fill_floats(float *values, size_t count)
{
    uint32_t seed = 2;
    for (size_t i = 0; i < count; i++)
        values[i] = ((float)test_random(&seed) - 8e6f) * powf(10.0f, (float)(i % 60) - 35.0f);
    values[3] = INFINITY;
    values[7] = -INFINITY;
    uint32_t payload = 0x7fc12345;
    memcpy(&values[11], &payload, sizeof payload);
}

/* ---- PNG ---- */

static void test_png_round_trip(void **state)
{
    test_folder *folder = *state;
    char path[512], again[512], flipped[512], alpha[512];
    static uint8_t rgba[HEIGHT][WIDTH + 2][4];
    fill_bytes(&rgba[0][0][0], sizeof rgba);
    ptrdiff_t stride = sizeof rgba[0];
    file_error error;
    in_folder(folder, "a.png", path);
    in_folder(folder, "b.png", again);
    assert_int_equal(picture_write_png(path, WIDTH, HEIGHT, &rgba[0][0][0], stride, &test_metadata, NULL, &error), FILE_OK);
    assert_int_equal(picture_write_png(again, WIDTH, HEIGHT, &rgba[0][0][0], stride, &test_metadata, NULL, &error), FILE_OK);
    assert_same_bytes(path, again);
    assert_metadata(path);
    assert_int_equal(picture_write_png(path, WIDTH, HEIGHT, &rgba[0][0][0], stride, NULL, NULL, &error), FILE_EXISTS);

    float_image image;
    assert_int_equal(picture_read(&image, path, NULL, &error), FILE_OK);
    assert_int_equal(image.width, WIDTH);
    assert_int_equal(image.height, HEIGHT);
    assert_int_equal(image.channels, 3);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            for (int c = 0; c < 3; c++)
                assert_true(image.pixels[(y * WIDTH + x) * 3 + c] == (float)rgba[y][x][c] / 255.0f);
    float_image_free(&image);

    /* A negative stride turns the picture upside down. */
    assert_int_equal(picture_write_png(in_folder(folder, "c.png", flipped), WIDTH, HEIGHT, &rgba[HEIGHT - 1][0][0], -stride, NULL, NULL, &error), FILE_OK);
    assert_int_equal(picture_read(&image, flipped, NULL, &error), FILE_OK);
    assert_true(image.pixels[0] == (float)rgba[HEIGHT - 1][0][0] / 255.0f);
    float_image_free(&image);

    assert_int_equal(picture_write_png_alpha(in_folder(folder, "d.png", alpha), WIDTH, HEIGHT, &rgba[0][0][0], stride, &test_metadata, NULL, &error), FILE_OK);
    assert_int_equal(picture_read(&image, alpha, NULL, &error), FILE_OK);
    assert_int_equal(image.channels, 4);
    assert_true(image.pixels[4 * WIDTH + 3] == (float)rgba[1][0][3] / 255.0f);
    float_image_free(&image);
}

/* Neither a time nor a physical size, which would differ or mean nothing; sRGB is declared. */
static void test_png_chunks(void **state)
{
    test_folder *folder = *state;
    char path[512];
    static uint8_t rgba[4 * 4 * 4];
    assert_int_equal(picture_write_png(in_folder(folder, "a.png", path), 4, 4, rgba, 0, &test_metadata, NULL, NULL), FILE_OK);
    size_t size;
    unsigned char *bytes = file_bytes(path, &size);
    assert_non_null(memmem(bytes, size, "sRGB", 4));
    assert_non_null(memmem(bytes, size, "tEXtrender_hash", 15));
    assert_non_null(memmem(bytes, size, "iTXttitle", 9));
    assert_null(memmem(bytes, size, "tIME", 4));
    assert_null(memmem(bytes, size, "pHYs", 4));
    free(bytes);
}

static void write_png_of_kind(const char *path, uint8_t depth, uint8_t color, const void *pixels, size_t size)
{
    FILE *stream = fopen(path, "wb");
    spng_ctx *context = spng_ctx_new(SPNG_CTX_ENCODER);
    struct spng_ihdr header = {.width = 2, .height = 2, .bit_depth = depth, .color_type = color};
    spng_set_png_file(context, stream);
    spng_set_ihdr(context, &header);
    assert_int_equal(spng_encode_image(context, pixels, size, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE), 0);
    spng_ctx_free(context);
    fclose(stream);
}

static void test_png_other_kinds(void **state)
{
    test_folder *folder = *state;
    char path[512];
    float_image image;
    const uint16_t deep[12] = {0, 1, 2, 300, 65535, 5, 6, 7, 8, 9, 10, 40000};
    write_png_of_kind(in_folder(folder, "deep.png", path), 16, SPNG_COLOR_TYPE_TRUECOLOR, deep, sizeof deep);
    assert_int_equal(picture_read(&image, path, NULL, NULL), FILE_OK);
    assert_int_equal(image.channels, 3);
    for (int i = 0; i < 12; i++)
        assert_true(image.pixels[i] == (float)deep[i] / 65535.0f);
    float_image_free(&image);

    const uint8_t grey[4] = {0, 100, 200, 255};
    write_png_of_kind(in_folder(folder, "grey.png", path), 8, SPNG_COLOR_TYPE_GRAYSCALE, grey, sizeof grey);
    assert_int_equal(picture_read(&image, path, NULL, NULL), FILE_OK);
    assert_int_equal(image.channels, 1);
    assert_true(image.pixels[2] == 200.0f / 255.0f);
    float_image_free(&image);

    const uint16_t grey_alpha[8] = {0, 65535, 1000, 65535, 2000, 65534, 3000, 65535};
    write_png_of_kind(in_folder(folder, "ga.png", path), 16, SPNG_COLOR_TYPE_GRAYSCALE_ALPHA, grey_alpha, sizeof grey_alpha);
    assert_int_equal(picture_read(&image, path, NULL, NULL), FILE_OK);
    assert_int_equal(image.channels, 2);
    assert_true(image.pixels[4] == 2000.0f / 65535.0f && image.pixels[5] == 65534.0f / 65535.0f);
    float_image_free(&image);
}

/* ---- PFM ---- */

static void test_pfm_round_trip(void **state)
{
    test_folder *folder = *state;
    char path[512], sidecar[512];
    static float values[HEIGHT][WIDTH][4];
    fill_floats(&values[0][0][0], sizeof values / sizeof(float));
    file_error error;
    for (uint32_t channels = 1; channels <= 3; channels += 2) {
        picture_layer layer = {.name = "color", .channels = channels, .pixels = &values[0][0][0], .pixel_floats = 4};
        float_image image;
        in_folder(folder, channels == 1 ? "a.pfm" : "b.pfm", path);
        assert_int_equal(picture_write_pfm(path, WIDTH, HEIGHT, &layer, &test_metadata, NULL, &error), FILE_OK);
        assert_metadata(path);
        assert_int_equal(picture_read(&image, path, "coverage", &error), FILE_OK);
        assert_int_equal(image.width, WIDTH);
        assert_int_equal(image.height, HEIGHT);
        assert_int_equal(image.channels, channels);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++)
                assert_memory_equal(&image.pixels[(size_t)(y * WIDTH + x) * channels], values[y][x], channels * sizeof(float));
        float_image_free(&image);
    }
    /* Bottom row first, little endian, as written in the format's description. */
    size_t size;
    unsigned char *bytes = file_bytes(in_folder(folder, "a.pfm", path), &size);
    assert_memory_equal(bytes, "Pf\n13 37\n-1.0\n", 14);
    assert_int_equal(size, 14 + WIDTH * HEIGHT * 4);
    assert_memory_equal(bytes + 14, values[HEIGHT - 1][0], 4);
    free(bytes);

    bytes = file_bytes(in_folder(folder, "a.pfm.json", sidecar), &size);
    assert_memory_equal(bytes, "{\n  \"render_hash\": \"0123456789abcdef\",\n  \"version\"", 50);
    free(bytes);
}

static void test_pfm_big_endian_and_spaces(void **state)
{
    test_folder *folder = *state;
    char path[512];
    static const unsigned char file[] = "PF \n 1\t1\r\n1.0 \x3f\x80\x00\x00\x40\x00\x00\x00\x7f\x80\x00\x00";
    float_image image;
    file_error error;
    write_bytes(in_folder(folder, "a.pfm", path), file, sizeof file - 1);
    assert_int_equal(picture_read(&image, path, NULL, &error), FILE_OK);
    assert_true(image.pixels[0] == 1.0f && image.pixels[1] == 2.0f && isinf(image.pixels[2]));
    float_image_free(&image);
}

static void test_pfm_bad_headers(void **state)
{
    test_folder *folder = *state;
    char path[512];
    static const char *const bad[] = {"",
                                      "P",
                                      "PF",
                                      "PF\n",
                                      "Pf\n1 1\n0.0\nabcd",
                                      "Pf\n1 1\nnan\nabcd",
                                      "Pf\n1 1\ninf\nabcd",
                                      "Pf\n0 1\n-1\n",
                                      "Pf\n1 0\n-1\n",
                                      "Pf\n-1 -1\n-1\nabcd",
                                      "Pf\n99999999999999999999 1\n-1\nabcd",
                                      "Pf\n4294967297 1\n-1\nabcd",
                                      "Pf\n1 1\n-1\nabcde",
                                      "Pf\n1 1\n-1\nabc",
                                      "Pf\n1000000 1000000\n-1\nabcd",
                                      "PFX\n1 1\n-1\nabcdabcdabcd",
                                      "Pf\n1 1\n-1x\nabcd",
                                      "Pf\n1 1",
                                      "Pf\n0x1 1\n-1\nabcd",
                                      "Pf 1 1 -1.0000000000000000000000000000000000000000000000000000000000 abcd",
                                      "Pf\n32769 0\n-1\n"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        float_image image;
        file_error error = {0};
        write_bytes(in_folder(folder, "a.pfm", path), bad[i], strlen(bad[i]));
        assert_int_equal(picture_read(&image, path, NULL, &error), FILE_BAD);
        assert_null(image.pixels);
        assert_non_null(strstr(error.text, "a.pfm"));
    }
}

static void test_pfm_replaces_its_sidecar(void **state)
{
    test_folder *folder = *state;
    char path[512], sidecar[512];
    float value = 1.0f;
    picture_layer layer = {.name = "depth", .channels = 1, .pixels = &value};
    output_options overwrite = {.overwrite = true};
    file_error error;
    in_folder(folder, "a.pfm", path);
    in_folder(folder, "a.pfm.json", sidecar);
    /* Someone's own file of that name is not taken away unasked. */
    write_bytes(sidecar, "{}", 2);
    assert_int_equal(picture_write_pfm(path, 1, 1, &layer, &test_metadata, NULL, &error), FILE_EXISTS);
    assert_false(file_exists(path));
    assert_int_equal(picture_write_pfm(path, 1, 1, &layer, &test_metadata, &overwrite, &error), FILE_OK);
    assert_metadata(path);
    /* A picture without metadata does not keep the record of the one before. */
    assert_int_equal(picture_write_pfm(path, 1, 1, &layer, NULL, &overwrite, &error), FILE_OK);
    assert_false(file_exists(sidecar));
    char *value_read = NULL;
    assert_int_equal(metadata_read(path, "render_hash", &value_read, &error), FILE_OK);
    assert_null(value_read);
}

/* ---- EXR ---- */

static void write_layers(const char *path, const float *values, const float *single, ptrdiff_t stride)
{
    picture_layer layers[] = {{.name = "color", .channels = 3, .pixels = values, .pixel_floats = 4, .row_stride = stride},
                              {.name = "coverage", .channels = 1, .pixels = single},
                              {.name = "mask", .channels = 1, .pixels = single + 5},
                              {.name = "depth", .channels = 1, .pixels = single + 9},
                              {.name = "normal", .channels = 3, .pixels = values + 1, .pixel_floats = 4},
                              {.name = "samples", .channels = 1, .pixels = single + 2}};
    file_error error;
    file_status status = picture_write_exr(path, WIDTH, HEIGHT, layers, 6, &test_metadata, NULL, &error);
    if (status != FILE_OK)
        print_error("%s\n", error.text);
    assert_int_equal(status, FILE_OK);
}

static void test_exr_round_trip(void **state)
{
    test_folder *folder = *state;
    char path[512], again[512];
    static float values[(HEIGHT + 1) * WIDTH * 4], single[WIDTH * HEIGHT + 16];
    fill_floats(values, sizeof values / sizeof(float));
    fill_floats(single, WIDTH * HEIGHT + 16);
    write_layers(in_folder(folder, "a.exr", path), values, single, 0);
    write_layers(in_folder(folder, "b.exr", again), values, single, WIDTH * 4 * sizeof(float));
    assert_same_bytes(path, again);
    assert_metadata(path);

    static const struct {
        const char *layer;
        uint32_t channels;
        int single_offset, value_offset;
    } expected[] = {{NULL, 3, -1, 0},     {"color", 3, -1, 0},   {"coverage", 1, 0, -1}, {"mask", 1, 5, -1}, {"depth", 1, 9, -1},
                    {"normal", 3, -1, 1}, {"samples", 1, 2, -1}, {"depth.Z", 1, 9, -1},  {"R", 1, -1, 0},    {"normal.Y", 1, -1, 2}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        float_image image;
        file_error error;
        assert_int_equal(picture_read(&image, path, expected[i].layer, &error), FILE_OK);
        assert_int_equal(image.width, WIDTH);
        assert_int_equal(image.height, HEIGHT);
        assert_int_equal(image.channels, expected[i].channels);
        for (size_t p = 0; p < WIDTH * HEIGHT; p++) {
            const float *want = expected[i].single_offset >= 0 ? single + p + expected[i].single_offset : values + 4 * p + expected[i].value_offset;
            assert_memory_equal(image.pixels + p * image.channels, want, image.channels * sizeof(float));
        }
        float_image_free(&image);
    }
    float_image image;
    file_error error;
    assert_int_equal(picture_read(&image, path, "sky", &error), FILE_ARGUMENT);
    assert_non_null(strstr(error.text, "depth.Z"));
}

/* Layers in parts of their own are read like those of one part; the attributes stand with the last. */
static void test_exr_parts(void **state)
{
    enum { W = 7, H = 19 };
    test_folder *folder = *state;
    static float values[W * H * 3];
    const metadata_entry attribute = {"note/of a part", "here"};
    const picture_layer layers[] = {{.name = "color", .channels = 3, .pixels = values},
                                    {.name = "mask", .channel = "A", .part = "color", .channels = 1, .pixels = values + 2},
                                    {.name = "depth", .channels = 1, .pixels = values + 5, .exact = true},
                                    {.name = "far", .channel = "Z", .channels = 1, .pixels = values + 9}};
    static const struct {
        const char *layer;
        uint32_t channels, offset;
    } expected[] = {{NULL, 3, 0}, {"A", 1, 2}, {"depth", 1, 5}, {"depth.Z", 1, 5}, {"far", 1, 9}, {"Z", 1, 9}};
    char path[512];
    fill_floats(values, W * H * 3);
    for (int packing = EXR_PACKING_ZIP; packing <= EXR_PACKING_NONE; packing++) {
        const exr_desc desc = {.packing = (exr_packing)packing, .parts = true, .attributes = &attribute, .attribute_count = 1};
        file_error error;
        assert_int_equal(picture_write_exr_described(in_folder(folder, "parts.exr", path), W, H, layers, 4, &desc, &test_metadata,
                                                     &(output_options){.overwrite = true}, &error),
                         FILE_OK);
        assert_metadata(path);
        for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
            float_image image;
            assert_int_equal(picture_read(&image, path, expected[i].layer, &error), FILE_OK);
            assert_int_equal(image.channels, expected[i].channels);
            assert_memory_equal(image.pixels, values + expected[i].offset, W * H * image.channels * sizeof(float));
            float_image_free(&image);
        }
        float_image none;
        assert_int_equal(picture_read(&none, path, "sky", &error), FILE_ARGUMENT);
        assert_non_null(strstr(error.text, "depth.Z, Z"));
    }
}

/* The specification's own examples. */
static void test_cryptomatte(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double id;
    } examples[] = {{"hello", 6.0705627102400005616e-17}, {"cube", -4.08461912519e+15}, {"sphere", 2.79018604383e+15}, {"plane", 3.66557617593e-11}};
    for (int i = 0; i < 4; i++)
        assert_true(fabs((double)cryptomatte_id(examples[i].name) / examples[i].id - 1) < 1e-7);
    assert_int_equal(cryptomatte_hash(""), 0);
    assert_int_equal(cryptomatte_bits(""), 1u << 23);
    static const char *const names[] = {"sky", "a \"b\"", "sky"};
    cryptomatte_header header;
    assert_true(cryptomatte_header_make(&header, "crypto_object", names, 3));
    assert_string_equal(header.entries[0].key, "cryptomatte/f834d0a/name");
    assert_string_equal(header.entries[1].value, "MurmurHash3_32");
    assert_non_null(strstr(header.manifest, "{\"sky\":\"d12be799\",\"a \\\"b\\\"\":\""));
    cryptomatte_header_free(&header);
}

/* Noise does not shrink, and blocks of rows with less and less noise come by one that is as long compressed as it is itself. */
static void test_exr_of_noise(void **state)
{
    enum { WIDTH_OF_NOISE = 16, BLOCK = 16 * WIDTH_OF_NOISE, BLOCKS = 48, VALUES = BLOCKS * BLOCK };
    test_folder *folder = *state;
    char path[512];
    static float values[VALUES];
    uint32_t seed = 1;
    for (int i = 0; i < BLOCK; i++) {
        seed = seed * 1664525u + 1013904223u;
        for (int block = 0; block < BLOCKS; block++)
            values[block * BLOCK + i] = i <= block ? 0 : ldexpf((float)(seed >> 8) - 8388608.0f, (int)(seed & 127) - 90);
    }
    for (int packing = EXR_PACKING_ZIP; packing <= EXR_PACKING_PIZ; packing++) {
        const exr_desc desc = {.packing = (exr_packing)packing};
        const picture_layer layer = {.name = "depth", .channels = 1, .pixels = values};
        float_image image;
        file_error error;
        in_folder(folder, "noise.exr", path);
        assert_int_equal(picture_write_exr_described(path, WIDTH_OF_NOISE, VALUES / WIDTH_OF_NOISE, &layer, 1, &desc, NULL,
                                                     &(output_options){.overwrite = true}, &error),
                         FILE_OK);
        assert_int_equal(picture_read(&image, path, NULL, &error), FILE_OK);
        assert_memory_equal(image.pixels, values, sizeof values);
        float_image_free(&image);
    }
}

static void test_exr_refuses_bad_layers(void **state)
{
    test_folder *folder = *state;
    char path[512];
    float value[3] = {0};
    in_folder(folder, "a.exr", path);
    picture_layer twice[] = {{.name = "mask", .channels = 1, .pixels = value}, {.name = "mask", .channels = 1, .pixels = value}};
    picture_layer two = {.name = "color", .channels = 2, .pixels = value};
    picture_layer dotted = {.name = "a.b", .channels = 1, .pixels = value};
    assert_int_equal(picture_write_exr(path, 1, 1, twice, 2, NULL, NULL, NULL), FILE_ARGUMENT);
    assert_int_equal(picture_write_exr(path, 1, 1, &two, 1, NULL, NULL, NULL), FILE_ARGUMENT);
    assert_int_equal(picture_write_exr(path, 1, 1, &dotted, 1, NULL, NULL, NULL), FILE_ARGUMENT);
    assert_int_equal(picture_write_exr(path, 1, 1, NULL, 0, NULL, NULL, NULL), FILE_ARGUMENT);
    assert_int_equal(picture_write_exr(path, 0, 1, &twice[0], 1, NULL, NULL, NULL), FILE_ARGUMENT);
    assert_int_equal(picture_write_exr(path, 100000, 100000, &twice[0], 1, NULL, NULL, NULL), FILE_ARGUMENT);
    assert_int_equal(folder_entries(folder->path), 0);
}

/* A file as other programs write them: half, float and uint channels, a data window off the origin, any compression. */
static void write_foreign_exr(const char *path, exr_compression_t compression)
{
    enum { W = 19, H = 40 };
    static uint16_t half[H][W];
    static float real[H][W];
    static uint32_t whole[H][W];
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++) {
            half[y][x] = (uint16_t)(0x3c00 + ((y * W + x) & 0x1ff)); /* 1 and a bit */
            real[y][x] = (float)(y * W + x);
            whole[y][x] = (uint32_t)(y * W + x);
        }
    exr_context_t context;
    exr_context_initializer_t initializer = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_attr_box2i_t display = {{{{0, 0}}}, {{{99, 99}}}}, data = {{{{-3, 5}}}, {{{-3 + W - 1, 5 + H - 1}}}};
    exr_attr_v2f_t center = {{{0, 0}}};
    int part;
    assert_int_equal(exr_start_write(&context, path, EXR_WRITE_FILE_DIRECTLY, &initializer), 0);
    assert_int_equal(exr_add_part(context, "other", EXR_STORAGE_SCANLINE, &part), 0);
    assert_int_equal(exr_initialize_required_attr(context, 0, &display, &data, 1.0f, &center, 1.0f, EXR_LINEORDER_INCREASING_Y, compression), 0);
    exr_add_channel(context, 0, "a.half", EXR_PIXEL_HALF, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    exr_add_channel(context, 0, "a.real", EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    exr_add_channel(context, 0, "a.whole", EXR_PIXEL_UINT, EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    assert_int_equal(exr_write_header(context), 0);
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    int32_t rows;
    exr_get_scanlines_per_chunk(context, 0, &rows);
    for (int y = 0; y < H; y += rows) {
        exr_chunk_info_t chunk;
        assert_int_equal(exr_write_scanline_chunk_info(context, 0, y + 5, &chunk), 0);
        if (y == 0)
            assert_int_equal(exr_encoding_initialize(context, 0, &chunk, &encoder), 0);
        else
            assert_int_equal(exr_encoding_update(context, 0, &chunk, &encoder), 0);
        for (int c = 0; c < 3; c++) {
            int bytes = encoder.channels[c].bytes_per_element;
            encoder.channels[c].user_pixel_stride = bytes;
            encoder.channels[c].user_line_stride = bytes * W;
            encoder.channels[c].encode_from_ptr = c == 0 ? (const uint8_t *)half[y] : c == 1 ? (const uint8_t *)real[y] : (const uint8_t *)whole[y];
        }
        if (y == 0)
            assert_int_equal(exr_encoding_choose_default_routines(context, 0, &encoder), 0);
        assert_int_equal(exr_encoding_run(context, 0, &encoder), 0);
    }
    exr_encoding_destroy(context, &encoder);
    assert_int_equal(exr_finish(&context), 0);
}

static void test_exr_of_others(void **state)
{
    test_folder *folder = *state;
    char path[512], name[32];
    static const exr_compression_t kinds[] = {EXR_COMPRESSION_NONE, EXR_COMPRESSION_RLE, EXR_COMPRESSION_ZIPS, EXR_COMPRESSION_ZIP, EXR_COMPRESSION_PIZ};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        snprintf(name, sizeof name, "other%zu.exr", k);
        write_foreign_exr(in_folder(folder, name, path), kinds[k]);
        float_image image;
        file_error error = {0};
        file_status status = picture_read(&image, path, NULL, &error); /* the only layer, "a" */
        if (status != FILE_OK)
            print_error("compression %d: %s\n", (int)kinds[k], error.text);
        assert_int_equal(status, FILE_OK);
        assert_int_equal(image.width, 19);
        assert_int_equal(image.height, 40);
        assert_int_equal(image.channels, 3);
        for (int i = 0; i < 19 * 40; i++) {
            assert_true(image.pixels[3 * i] == 1.0f + (float)(i & 0x1ff) / 1024.0f);
            assert_true(image.pixels[3 * i + 1] == (float)i);
            assert_true(image.pixels[3 * i + 2] == (float)i);
        }
        float_image_free(&image);
    }
}

/* What would be unpacked wrongly is refused by its name, whatever follows the header. */
static void test_exr_refused(void **state)
{
    test_folder *folder = *state;
    char path[512];
    static const struct {
        char compression;
        const char *message;
    } cases[] = {{EXR_COMPRESSION_B44, "B44 compression without half channels is not supported; allowed: none, RLE"},
                 {EXR_COMPRESSION_B44A, "B44 compression without half channels is not supported; allowed: none, RLE"},
                 {EXR_COMPRESSION_DWAA, "DWA compression is not supported; allowed: none, RLE"},
                 {EXR_COMPRESSION_DWAB, "DWA compression is not supported; allowed: none, RLE"}};
    static const char key[] = "compression\0compression\0\1\0\0";
    const float pixel = 1;
    const picture_layer layer = {.name = "depth", .channels = 1, .pixels = &pixel};
    assert_int_equal(picture_write_exr(in_folder(folder, "refused.exr", path), 1, 1, &layer, 1, NULL, NULL, NULL), FILE_OK);
    size_t size;
    unsigned char *bytes = file_bytes(path, &size), *at = memmem(bytes, size, key, sizeof key);
    assert_non_null(at);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        float_image image;
        file_error error = {0};
        at[sizeof key] = (unsigned char)cases[i].compression;
        write_bytes(path, bytes, size);
        assert_int_equal(picture_read(&image, path, NULL, &error), FILE_BAD);
        assert_non_null(strstr(error.text, cases[i].message));
    }
    free(bytes);
}

/* ---- damaged files ---- */

/* Every beginning of a good file is an error, and no changed byte does more than give an error or other pixels. The last
 * `idle_bytes` of the file say nothing. */
static void damage(const test_folder *folder, const char *good, size_t idle_bytes)
{
    char path[512];
    size_t size;
    unsigned char *bytes = file_bytes(good, &size);
    unsigned char *copy = malloc(size);
    in_folder(folder, "damaged", path);
    for (size_t length = 0; length < size - idle_bytes; length++) {
        float_image image;
        file_error error = {0};
        char *value = NULL;
        write_bytes(path, bytes, length);
        file_status status = picture_read(&image, path, NULL, &error);
        if (status != FILE_BAD)
            print_error("%s cut to %zu of %zu bytes: %d %s\n", good, length, size, status, error.text);
        assert_int_equal(status, FILE_BAD);
        assert_null(image.pixels);
        assert_true(error.text[0] != '\0');
        metadata_read(path, "render_hash", &value, &error);
        free(value);
    }
    uint32_t seed = 5;
    for (size_t i = 0; i < 2 * size; i++) {
        float_image image;
        char *value = NULL;
        memcpy(copy, bytes, size);
        copy[i % size] ^= (unsigned char)(i < size ? 0xff : 1 + test_random(&seed) % 255);
        write_bytes(path, copy, size);
        if (picture_read(&image, path, NULL, NULL) == FILE_OK)
            float_image_free(&image);
        metadata_read(path, "render_hash", &value, NULL);
        free(value);
    }
    free(copy);
    free(bytes);
}

static void test_damaged_png(void **state)
{
    test_folder *folder = *state;
    char path[512];
    uint8_t rgba[5 * 4 * 4];
    fill_bytes(rgba, sizeof rgba);
    assert_int_equal(picture_write_png(in_folder(folder, "a.png", path), 5, 4, rgba, 0, &test_metadata, NULL, NULL), FILE_OK);
    damage(folder, path, 4); /* the checksum of the empty end mark */
}

static void test_damaged_pfm(void **state)
{
    test_folder *folder = *state;
    char path[512];
    float values[5 * 4 * 3];
    fill_floats(values, 60);
    picture_layer layer = {.name = "color", .channels = 3, .pixels = values};
    assert_int_equal(picture_write_pfm(in_folder(folder, "a.pfm", path), 5, 4, &layer, NULL, NULL, NULL), FILE_OK);
    damage(folder, path, 0);
}

static void test_damaged_exr(void **state)
{
    test_folder *folder = *state;
    char path[512];
    float values[5 * 18 * 3];
    fill_floats(values, 270);
    picture_layer layer = {.name = "color", .channels = 3, .pixels = values};
    metadata_list metadata = {test_entries, 1};
    assert_int_equal(picture_write_exr(in_folder(folder, "a.exr", path), 5, 18, &layer, 1, &metadata, NULL, NULL), FILE_OK);
    damage(folder, path, 0);
}

static void test_unreadable_inputs(void **state)
{
    test_folder *folder = *state;
    char path[512];
    float_image image;
    file_error error;
    char *value;
    assert_int_equal(picture_read(&image, in_folder(folder, "none.png", path), NULL, &error), FILE_MISSING);
    assert_non_null(strstr(error.text, "No such file"));
    assert_int_equal(metadata_read(path, "a", &value, &error), FILE_MISSING);
    assert_int_equal(picture_read(&image, folder->path, NULL, &error), FILE_MISSING);
    assert_int_equal(mkfifo(in_folder(folder, "pipe.exr", path), 0600), 0);
    assert_int_equal(picture_read(&image, path, NULL, &error), FILE_MISSING); /* and does not wait for a writer */
    write_bytes(in_folder(folder, "text.png", path), "hello, this is text", 19);
    assert_int_equal(picture_read(&image, path, NULL, &error), FILE_BAD);
    assert_non_null(strstr(error.text, "is not a PNG, EXR or PFM"));
}

static void test_damaged_sidecars(void **state)
{
    test_folder *folder = *state;
    char path[512], sidecar[512];
    static const char *const bad[] = {"", "{", "[]", "3", "{\"a\": \"b\"", "{\"a\": 1} x", "{\"a\":\"b\",\"a\":\"c\"}", "\xff\xfe"};
    write_bytes(in_folder(folder, "a.y4m", path), "YUV4MPEG2", 9);
    in_folder(folder, "a.y4m.json", sidecar);
    char *value = NULL;
    file_error error;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        write_bytes(sidecar, bad[i], strlen(bad[i]));
        assert_int_equal(metadata_read(path, "a", &value, &error), FILE_BAD);
        assert_null(value);
    }
    write_bytes(sidecar, "{\"a\": 1}", 8);
    assert_int_equal(metadata_read(path, "a", &value, &error), FILE_OK);
    assert_null(value);
    unlink(sidecar);
    assert_int_equal(metadata_read(path, "a", &value, &error), FILE_OK);
    assert_null(value);
}

static void test_metadata_rules(void **state)
{
    (void)state;
    char long_key[81];
    memset(long_key, 'k', 80);
    long_key[80] = '\0';
    const metadata_entry bad[] =
        {{"", "v"},         {"a b", "v"},          {"a=b", "v"},      {long_key, "v"},          {NULL, "v"}, {"a", NULL}, {"a", "\xff"},
         {"a", "\xc0\x80"}, {"a", "\xed\xa0\x80"}, {"a", "\xe2\x82"}, {"a", "\xf4\x90\x80\x80"}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        metadata_list list = {&bad[i], 1};
        file_error error;
        assert_int_equal(metadata_check(&list, &error), FILE_ARGUMENT);
    }
    const metadata_entry twice[] = {{"a", "1"}, {"b", "2"}, {"a", "1"}};
    assert_int_equal(metadata_check(&(metadata_list){twice, 3}, NULL), FILE_ARGUMENT);
    assert_int_equal(metadata_check(&(metadata_list){twice, 2}, NULL), FILE_OK);
    assert_int_equal(metadata_check(&test_metadata, NULL), FILE_OK);
    assert_int_equal(metadata_check(NULL, NULL), FILE_OK);
}

static void test_formats_by_name(void **state)
{
    (void)state;
    assert_int_equal(picture_format_of("a.png"), PICTURE_PNG);
    assert_int_equal(picture_format_of("b.c/a.EXR"), PICTURE_EXR);
    assert_int_equal(picture_format_of("a.b.pfm"), PICTURE_PFM);
    assert_int_equal(picture_format_of("a.mp4"), PICTURE_MP4);
    assert_int_equal(picture_format_of("a.y4m"), PICTURE_Y4M);
    assert_int_equal(picture_format_of("png"), PICTURE_UNKNOWN);
    assert_int_equal(picture_format_of("dir.png/a"), PICTURE_UNKNOWN);
    assert_int_equal(picture_format_of(""), PICTURE_UNKNOWN);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, folder_setup, folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(test_png_round_trip),
        IN_FOLDER(test_png_chunks),
        IN_FOLDER(test_png_other_kinds),
        IN_FOLDER(test_pfm_round_trip),
        IN_FOLDER(test_pfm_big_endian_and_spaces),
        IN_FOLDER(test_pfm_bad_headers),
        IN_FOLDER(test_pfm_replaces_its_sidecar),
        IN_FOLDER(test_exr_round_trip),
        IN_FOLDER(test_exr_of_noise),
        IN_FOLDER(test_exr_parts),
        cmocka_unit_test(test_cryptomatte),
        IN_FOLDER(test_exr_refuses_bad_layers),
        IN_FOLDER(test_exr_of_others),
        IN_FOLDER(test_exr_refused),
        IN_FOLDER(test_damaged_png),
        IN_FOLDER(test_damaged_pfm),
        IN_FOLDER(test_damaged_exr),
        IN_FOLDER(test_unreadable_inputs),
        IN_FOLDER(test_damaged_sidecars),
        cmocka_unit_test(test_metadata_rules),
        cmocka_unit_test(test_formats_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
