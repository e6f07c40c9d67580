/* SPDX-License-Identifier: MIT
 *
 * Spectra as buoys' owners publish them.
 */
#include "scene/buoy_files.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene_text.h"
#include "sea/spectrum_math.h"

enum { MAX_BYTES = 16 * 1024 * 1024, BINS = 256, DIRECTIONS = 72, PATH_SIZE = 4096 };

static const char BYTE_ORDER_MARK[] = "\xef\xbb\xbf"; /* of UTF-8; some editors write it */

static const double DEGREE = SPECTRUM_PI / 180, MISSING = 999, LOWEST = 1e-4, HIGHEST = 100 /* Hz */;

/* ---- files -------------------------------------------------------------------------------------------------- */

static bool refuse_file(scene_error *error, scene_error_kind kind, const char *path, const char *what)
{
    return scene_error_set(error, kind, "%s: %s; allowed: a table of frequency, direction and density, or a file of NDBC's or Datawell's, of at most 16 MiB",
                           scene_file_name(path).text, what);
}

char *buoy_file_read(const char *path, size_t *length, scene_error *error)
{
    regular_file read;
    char *text = regular_file_read(&read, path, false, MAX_BYTES, "is larger than 16 MiB", length);
    if (text == NULL) {
        refuse_file(error, scene_error_of_fault(read.fault), path, read.what);
        return NULL;
    }
    if (strncmp(text, BYTE_ORDER_MARK, strlen(BYTE_ORDER_MARK)) == 0) {
        *length -= strlen(BYTE_ORDER_MARK);
        memmove(text, text + strlen(BYTE_ORDER_MARK), *length + 1);
    }
    return text;
}

/* ---- words -------------------------------------------------------------------------------------------------- */

/* Where a text is read. */
typedef struct buoy_reader {
    const char *path, *line, *at;
    int number; /* of the line */
    scene_error *error;
} buoy_reader;

static scene_place place_of(const buoy_reader *r, const char *at) { return (scene_place){r->number, (int)(at - r->line) + 1}; }

static bool refuse(const buoy_reader *r, const char *at, const char *what, const char *allowed)
{
    const scene_place place = place_of(r, at);
    return scene_error_set(r->error, SCENE_ERROR_BAD_SCENE, "%s:%d:%d: %s; allowed: %s", scene_file_name(r->path).text, place.line, place.column, what,
                           allowed);
}

static bool is_blank(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r'; }

/* The next word of the line; of length 0 at its end. */
typedef struct buoy_word {
    const char *text;
    size_t length;
} buoy_word;

static buoy_word next_word(buoy_reader *r)
{
    while (is_blank(*r->at))
        r->at++;
    const buoy_word word = {r->at, strcspn(r->at, " \t,\r\n")};
    r->at += word.length;
    return word;
}

/* Goes to the first line after this one that is not empty; false at the end. */
static bool next_line(buoy_reader *r)
{
    while (*r->at != '\0') {
        r->at += strcspn(r->at, "\n");
        if (*r->at == '\0')
            return false;
        r->line = ++r->at;
        r->number++;
        if (r->line[strspn(r->line, " \t,\r\n")] != '\0' && strchr("\r\n", r->line[strspn(r->line, " \t,")]) == NULL)
            return true;
    }
    return false;
}

/* A decimal number, alone or in round brackets. */
static bool word_number(buoy_word word, double *value)
{
    char text[32], *end;
    if (word.length > 1 && word.text[0] == '(' && word.text[word.length - 1] == ')')
        word = (buoy_word){word.text + 1, word.length - 2};
    if (word.length == 0 || word.length >= sizeof text)
        return false;
    memcpy(text, word.text, word.length);
    text[word.length] = '\0';
    if (strspn(text, "+-.0123456789eE") < word.length)
        return false;
    *value = strtod(text, &end);
    return *end == '\0' && isfinite(*value);
}

/* ---- the plain table ---------------------------------------------------------------------------------------- */

/* Says where in the buoy's file the lines that follow come from, for messages about them. */
static void write_place(FILE *stream, scene_place place) { fprintf(stream, BUOY_PLACE "\n", place.line, place.column); }

/* Writes a frequency's density spread by the shares, which need not add up to 1; negative ones count as 0. */
static void write_bin(FILE *stream, scene_place place, double frequency, double density, const double shares[DIRECTIONS])
{
    write_place(stream, place);
    double sum = 0;
    for (int i = 0; i < DIRECTIONS; i++)
        sum += fmax(shares[i], 0);
    for (int i = 0; i < DIRECTIONS; i++)
        fprintf(stream, "%.9g %d %.9g\n", frequency, 360 / DIRECTIONS * i, sum > 0 ? density * fmax(shares[i], 0) / (sum * (360 / DIRECTIONS) * DEGREE) : 0);
}

/* ---- Datawell ----------------------------------------------------------------------------------------------- */

enum { SYSTEM_LINES = 12, DENSITY_LINE = 4 };

/* cos^2s of half the angle with this standard deviation in degrees (Kuik et al. 1988). */
static void spread_datawell(double direction, double deviation, double shares[DIRECTIONS])
{
    const double radians = fmax(deviation, 1) * DEGREE, s = fmax(2 / (radians * radians) - 1, 0);
    for (int i = 0; i < DIRECTIONS; i++) {
        const double turns = (360.0 / DIRECTIONS * i - direction) / 360, angle = 2 * SPECTRUM_PI * (turns - floor(turns + 0.5));
        shares[i] = portable_pow(portable_cos(angle / 2), 2 * s);
    }
}

/* Twelve lines about the buoy, of which the fourth is the greatest density, and then frequency, share of it, direction, spread, skewness, kurtosis. */
static bool convert_datawell(buoy_reader *r, FILE *stream)
{
    double most = 0, last = 0;
    for (int i = 1; i <= SYSTEM_LINES; i++) {
        const buoy_word word = next_word(r);
        double value;
        if (!word_number(word, &value) || (i == DENSITY_LINE && !(value >= 0 && value <= 1e4)))
            return refuse(r, word.text, "this is no number about the buoy", "twelve lines of one number each, the fourth the greatest density in m²/Hz");
        if (i == DENSITY_LINE && !(value > 0))
            return refuse(r, word.text, "the greatest density is 0: the buoy saw no waves", "a density above 0 in m²/Hz");
        most = i == DENSITY_LINE ? value : most;
        if (!next_line(r))
            return refuse(r, r->at, "the file ends before its spectrum",
                          "twelve lines of one number each, then lines of frequency, density, direction, spread");
    }
    do {
        double values[4], shares[DIRECTIONS];
        for (int i = 0; i < 4; i++) {
            const buoy_word word = next_word(r);
            if (!word_number(word, &values[i]))
                return refuse(r, word.text, "a number is missing", "frequency (Hz), share of the greatest density, direction and spread (degrees)");
        }
        if (!(values[0] > last && values[0] >= LOWEST && values[0] <= HIGHEST) || !(values[1] >= 0 && values[1] <= 1000) || !(fabs(values[2]) <= 720) ||
            !(values[3] >= 0 && values[3] <= 360))
            return refuse(r, r->line, "these are not frequency, density, direction and spread",
                          "rising frequencies of 0.0001 to 100 Hz, shares of the greatest density, degrees");
        last = values[0];
        spread_datawell(values[2], values[3], shares);
        write_bin(stream, place_of(r, r->line), values[0], values[1] * most, shares);
    } while (next_line(r));
    return true;
}

/* ---- NDBC --------------------------------------------------------------------------------------------------- */

typedef struct ndbc_record {
    char time[32]; /* "2026 01 31 12 40" */
    size_t count;
    double frequency[BINS], value[BINS]; /* MISSING or more: not measured */
    scene_place place[BINS];             /* of the values */
    int frequency_line;
    bool archived; /* the header has the frequencies, and r1 and r2 are hundredths */
} ndbc_record;

static const char NDBC_ALLOWED[] = "#YY MM DD hh mm and frequencies, or records of such a time and value (frequency) value (frequency) …";

/* The frequencies of an archived file's header; of a real-time file it has none. */
static bool read_frequencies(buoy_reader *r, ndbc_record *record)
{
    double value, last = 0;
    for (int i = 0; i < 5; i++)
        next_word(r);
    for (buoy_word word = next_word(r); word.length > 0 && word_number(word, &value); word = next_word(r)) {
        if (record->count == BINS || !(value > last && value >= LOWEST && value <= HIGHEST))
            return refuse(r, word.text, "this is no frequency of the spectrum", "at most 256 rising frequencies to 100 Hz");
        record->frequency[record->count++] = last = value;
    }
    record->archived = record->count > 0;
    record->frequency_line = r->number;
    return true;
}

static void read_time(buoy_reader *r, char time[32])
{
    size_t used = 0;
    for (int i = 0; i < 5; i++) {
        const buoy_word word = next_word(r);
        used += (size_t)snprintf(time + used, 32 - used, "%s%.*s", i > 0 ? " " : "", word.length < 5 ? (int)word.length : 4, word.text);
    }
}

/* "MM" stands for what was not measured. */
static bool read_value(buoy_reader *r, buoy_word word, double *value)
{
    *value = MISSING;
    return (word.length == 2 && memcmp(word.text, "MM", 2) == 0) || word_number(word, value) || refuse(r, word.text, "this is no number", NDBC_ALLOWED);
}

static bool read_values(buoy_reader *r, ndbc_record *record)
{
    size_t count = 0;
    double last = 0;
    for (buoy_word word = next_word(r); word.length > 0; word = next_word(r)) {
        double value, frequency;
        if (!read_value(r, word, &value))
            return false;
        if (record->archived) {
            if (count == record->count)
                return refuse(r, word.text, "there are more values than frequencies", NDBC_ALLOWED);
            record->place[count] = place_of(r, word.text);
            record->value[count++] = value;
            continue;
        }
        const char *after = r->at;
        const buoy_word bracket = next_word(r);
        if (bracket.length == 0 || bracket.text[0] != '(') { /* the frequency that parts swell from wind sea */
            if (count > 0)
                return refuse(r, word.text, "a value has no frequency", NDBC_ALLOWED);
            r->at = after;
            continue;
        }
        if (!word_number(bracket, &frequency) || !(frequency > last && frequency >= LOWEST && frequency <= HIGHEST) || count == BINS)
            return refuse(r, bracket.text, "this is no frequency of the spectrum", "at most 256 rising frequencies to 100 Hz");
        record->frequency[count] = last = frequency;
        record->frequency_line = r->number;
        record->place[count] = place_of(r, word.text);
        record->value[count++] = value;
    }
    if (count < 2 || (record->archived && count < record->count))
        return refuse(r, r->line, "there are fewer values than frequencies", NDBC_ALLOWED);
    record->count = count;
    return true;
}

/* The record of a time; NULL: the first one. */
static bool read_record(const char *path, const char *text, const char *time, ndbc_record *record, scene_error *error)
{
    buoy_reader r = {.path = path, .line = text, .at = text, .number = 1, .error = error};
    *record = (ndbc_record){0};
    if (text[0] != '#')
        return refuse(&r, text, "the header is missing", NDBC_ALLOWED);
    if (!read_frequencies(&r, record))
        return false;
    while (next_line(&r)) {
        if (*r.line == '#')
            continue;
        read_time(&r, record->time);
        if (time == NULL || strcmp(record->time, time) == 0)
            return read_values(&r, record);
    }
    return scene_error_set(error, SCENE_ERROR_BAD_SCENE, "%s: there is no record %s%s; allowed: files of the same buoy and time", scene_file_name(path).text,
                           time != NULL ? "of " : "at all", time != NULL ? time : "");
}

/* The name of the file with another quantity. */
static bool name_beside(const char *path, int quantity, char out[PATH_SIZE])
{
    static const char *const endings[] = {".swdir", ".swdir2", ".swr1", ".swr2"};
    static const char letters[] = "dijk", density[] = ".data_spec";
    const size_t length = strlen(path), end = sizeof density - 1;
    const char *slash = strrchr(path, '/'), *name = slash != NULL ? slash + 1 : path, *letter = strrchr(name, 'w');
    if (length + 8 > PATH_SIZE)
        return false;
    if (length > end && strcmp(path + length - end, density) == 0)
        return snprintf(out, PATH_SIZE, "%.*s%s", (int)(length - end), path, endings[quantity]) > 0;
    if (letter == NULL || letter == name || !isdigit((unsigned char)letter[-1]))
        return false;
    snprintf(out, PATH_SIZE, "%s", path);
    out[letter - path] = letters[quantity];
    return true;
}

static bool read_beside(const char *path, const ndbc_record *density, int quantity, ndbc_record *record, scene_error *error)
{
    char name[PATH_SIZE];
    size_t length;
    scene_place place;
    if (!name_beside(path, quantity, name))
        return scene_error_set(error, SCENE_ERROR_BAD_SCENE,
                               "%s: the name does not say where its directions are; allowed: STATION.data_spec, or STATIONwYEAR.txt",
                               scene_file_name(path).text);
    char *text = buoy_file_read(name, &length, error);
    if (text == NULL)
        return false;
    bool good = scene_text_is_clean(text, length, &place) || scene_error_set(error, SCENE_ERROR_BAD_SCENE, "%s:%d:%d: not a text file; allowed: %s",
                                                                             scene_file_name(name).text, place.line, place.column, NDBC_ALLOWED);
    good = good && read_record(name, text, density->time, record, error);
    if (good && (record->count != density->count || memcmp(record->frequency, density->frequency, record->count * sizeof record->frequency[0]) != 0))
        good = scene_error_set(error, SCENE_ERROR_BAD_SCENE, "%s:%d:1: it has other frequencies than %s; allowed: files of the same buoy and time",
                               scene_file_name(name).text, record->frequency_line, scene_file_name(path).text);
    free(text);
    return good;
}

/* r1 or r2 with its angle; what was not measured has no preferred direction. */
static double coefficient(const ndbc_record *record, const ndbc_record *angles, size_t bin)
{
    const double value = record->value[bin] * (record->archived && record->value[bin] < MISSING ? 0.01 : 1);
    return value >= 0 && value <= 1 && fabs(angles->value[bin]) <= 720 ? value : 0;
}

/* 1/2 + r1 cos(θ - α1) + r2 cos 2(θ - α2), θ where waves come from. */
static void spread_ndbc(const ndbc_record quantities[4], size_t bin, double shares[DIRECTIONS])
{
    const double first = coefficient(&quantities[2], &quantities[0], bin), second = coefficient(&quantities[3], &quantities[1], bin);
    const double alpha1 = first > 0 ? quantities[0].value[bin] : 0, alpha2 = second > 0 ? quantities[1].value[bin] : 0;
    for (int i = 0; i < DIRECTIONS; i++) {
        const double angle = 360.0 / DIRECTIONS * i;
        shares[i] = 0.5 + first * portable_cos((angle - alpha1) * DEGREE) + second * portable_cos(2 * (angle - alpha2) * DEGREE);
    }
}

static bool convert_ndbc(const char *path, const char *text, FILE *stream, scene_error *error)
{
    ndbc_record density, *quantities = calloc(4, sizeof *quantities);
    if (quantities == NULL)
        return scene_error_memory(error);
    bool good = read_record(path, text, NULL, &density, error);
    for (int i = 0; good && i < 4; i++)
        good = read_beside(path, &density, i, &quantities[i], error);
    if (good)
        write_place(stream, density.place[0]);
    for (size_t bin = 0; good && bin < density.count; bin++) {
        double shares[DIRECTIONS];
        if (density.value[bin] >= 0 && density.value[bin] < MISSING) {
            spread_ndbc(quantities, bin, shares);
            write_bin(stream, density.place[bin], density.frequency[bin], density.value[bin], shares);
        }
    }
    free(quantities);
    return good;
}

/* ---- either ------------------------------------------------------------------------------------------------- */

buoy_format buoy_format_of(const char *text)
{
    buoy_reader r = {.line = text, .at = text, .number = 1};
    double value;
    if (strncmp(text, "#YY", 3) == 0)
        return BUOY_NDBC;
    const bool number = word_number(next_word(&r), &value);
    return number && next_word(&r).length == 0 ? BUOY_DATAWELL : BUOY_TABLE;
}

char *buoy_file_convert(buoy_format format, const char *path, const char *text, scene_error *error)
{
    char *table = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&table, &size);
    if (stream == NULL) {
        scene_error_memory(error);
        return NULL;
    }
    fputs("frequency direction density_rad\n", stream);
    buoy_reader r = {.path = path, .line = text, .at = text, .number = 1, .error = error};
    bool good = format == BUOY_NDBC ? convert_ndbc(path, text, stream, error) : convert_datawell(&r, stream);
    if (fclose(stream) != 0 && good)
        good = scene_error_memory(error);
    if (good)
        return table;
    free(table);
    return NULL;
}
