/* SPDX-License-Identifier: MIT
 *
 * Directional wave spectra as buoys report them.
 */
#include "scene/spectrum_table_read.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/buoy_files.h"
#include "sea/spectrum_math.h"

enum { FREQUENCY, DIRECTION, DENSITY, COLUMNS };

static const double TURN = 2 * SPECTRUM_PI, WIDEST_GAP = SPECTRUM_WIDEST_GAP, MOST_AMPLITUDE = 1000 /* of a scene's wave, m */;

/* ---- lines into points -------------------------------------------------------------------------------------- */

/* A word of a line, and what it should be. */
typedef struct table_word {
    const char *text;
    size_t length;
    int column; /* from 1 */
} table_word;

typedef struct table_reader {
    spectrum_table *table;
    const char *name;
    scene_error *error;
    size_t room; /* points */
    int line;
    int column;        /* of a converted table: where its lines come from; else 0 */
    bool begun;        /* a header or a row was read */
    double per_radian; /* factor from the file's density to that per radian */
} table_reader;

static const struct {
    const char *name;
    double min, max;
    const char *allowed;
} columns[COLUMNS] = {
    {"frequency", 1e-4, 100, "a number, 0.0001 to 100 Hz"},
    {"direction", -360, 360, "a number, -360 to 360 degrees"},
    {"density", 0, 1e9, "a number, 0 to 1e9"},
};

static bool refuse(const table_reader *r, int column, const char *format, ...) SCENE_FORMAT(3, 4);

static bool refuse(const table_reader *r, int column, const char *format, ...)
{
    char what[320];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return scene_error_set(r->error, SCENE_ERROR_BAD_SCENE, "%s:%d:%d: %s", scene_file_name(r->name).text, r->line, column, what);
}

static bool is_separator(char c) { return c == ' ' || c == '\t' || c == ',' || c == '\r'; }

/* The words before a comment; one more than there are columns is enough to see that there are too many. */
static size_t split(const char *line, size_t length, table_word words[COLUMNS + 1])
{
    size_t count = 0, at = 0;
    int column = 1;
    while (at < length && line[at] != '#' && count <= COLUMNS) {
        if (is_separator(line[at])) {
            at++;
            column++;
            continue;
        }
        table_word *word = &words[count++];
        *word = (table_word){.text = line + at, .column = column};
        for (; at < length && !is_separator(line[at]) && line[at] != '#'; at++, word->length++)
            column += ((unsigned char)line[at] & 0xc0) != 0x80;
    }
    return count;
}

static bool word_is(const table_word *word, const char *text) { return strlen(text) == word->length && memcmp(word->text, text, word->length) == 0; }

static bool read_header(table_reader *r, const table_word *words, size_t count)
{
    const bool per_radian = count == COLUMNS && word_is(&words[DENSITY], "density_rad");
    if (count != COLUMNS || !word_is(&words[FREQUENCY], "frequency") || !word_is(&words[DIRECTION], "direction") ||
        (!per_radian && !word_is(&words[DENSITY], "density")))
        return refuse(r, words[0].column, "these are not the names of the columns; allowed: frequency direction density, or frequency direction density_rad");
    r->per_radian = per_radian ? 1 : 180 / SPECTRUM_PI;
    return true;
}

/* The whole word as a decimal number. */
static bool read_number(const table_word *word, double *value)
{
    char text[64], *end;
    if (word->length >= sizeof text)
        return false;
    memcpy(text, word->text, word->length);
    text[word->length] = '\0';
    if (strspn(text, "+-.0123456789eE") < word->length)
        return false;
    *value = strtod(text, &end);
    return *end == '\0' && end != text && isfinite(*value);
}

static bool add_point(table_reader *r, const double values[COLUMNS], int column)
{
    spectrum_table *table = r->table;
    const double frequency = TURN * values[FREQUENCY];
    const spectrum_row *last = table->row_count > 0 ? &table->rows[table->row_count - 1] : NULL;
    if (last != NULL && frequency < last->frequency)
        return refuse(r, column, "frequency falls from %g to %g Hz; allowed: rising, the lines of one frequency together", last->frequency / TURN,
                      values[FREQUENCY]);
    if (table->point_count == SPECTRUM_TABLE_POINTS)
        return refuse(r, column, "too many lines; allowed: at most %d", SPECTRUM_TABLE_POINTS);
    if (table->point_count == r->room) {
        const size_t room = r->room > 0 ? 2 * r->room : 1024;
        spectrum_point *points = realloc(table->points, room * sizeof *points);
        if (points == NULL)
            return scene_error_memory(r->error);
        table->points = points;
        spectrum_row *rows = realloc(table->rows, room * sizeof *rows);
        if (rows == NULL)
            return scene_error_memory(r->error);
        table->rows = rows;
        r->room = room;
        last = table->row_count > 0 ? &rows[table->row_count - 1] : NULL;
    }
    if (last == NULL || frequency > last->frequency)
        table->rows[table->row_count++] = (spectrum_row){.frequency = frequency, .first = table->point_count};
    double turns = (values[DIRECTION] + 180) / 360;
    turns -= floor(turns);
    table->rows[table->row_count - 1].count++;
    table->points[table->point_count++] =
        (spectrum_point){.azimuth = TURN * turns, .density = r->per_radian * values[DENSITY] / TURN, .line = r->line, .column = column};
    return true;
}

static bool read_line(table_reader *r, const char *line, size_t length)
{
    table_word words[COLUMNS + 1];
    double values[COLUMNS];
    const size_t count = split(line, length, words);
    if (count == 0 && r->column > 0)
        sscanf(line, BUOY_PLACE, &r->line, &r->column);
    if (count == 0)
        return true;
    const bool first = !r->begun;
    r->begun = true;
    if (first && (words[0].text[0] | 32) >= 'a' && (words[0].text[0] | 32) <= 'z')
        return read_header(r, words, count);
    if (count != COLUMNS)
        return refuse(r, count > COLUMNS ? words[COLUMNS].column : words[0].column, "%s columns; allowed: frequency, direction and density, a line each",
                      count > COLUMNS ? "more than three"
                      : count == 1    ? "one of three"
                                      : "two of three");
    for (int i = 0; i < COLUMNS; i++)
        if (!read_number(&words[i], &values[i]) || values[i] < columns[i].min || values[i] > columns[i].max) {
            const scene_quote quote = scene_quote_text(words[i].text, words[i].length);
            return refuse(r, words[i].column, "%s is %s; allowed: %s", columns[i].name, quote.text, columns[i].allowed);
        }
    return add_point(r, values, r->column > 0 ? r->column : words[0].column);
}

/* ---- rows --------------------------------------------------------------------------------------------------- */

static int compare_points(const void *left, const void *right)
{
    const double a = ((const spectrum_point *)left)->azimuth, b = ((const spectrum_point *)right)->azimuth;
    return (a > b) - (a < b);
}

/* Refuses the table at the line of a point. */
static bool refuse_at(table_reader *r, const spectrum_point *point, const char *wrong)
{
    r->line = point->line;
    return refuse(r, point->column, "%s", wrong);
}

static bool finish_row(table_reader *r, spectrum_row *row)
{
    spectrum_point *points = r->table->points + row->first;
    char wrong[128];
    if (row->count < 2) {
        snprintf(wrong, sizeof wrong, "frequency %g Hz has one direction; allowed: at least two", row->frequency / TURN);
        return refuse_at(r, points, wrong);
    }
    qsort(points, row->count, sizeof *points, compare_points);
    for (size_t i = 0; i < row->count; i++) {
        const spectrum_point *next = &points[(i + 1) % row->count];
        const double gap = spectrum_row_gap(points, row->count, i);
        if (gap < 1e-9) {
            snprintf(wrong, sizeof wrong, "frequency %g Hz has a direction twice; allowed: each once", row->frequency / TURN);
            return refuse_at(r, next->line > points[i].line ? next : &points[i], wrong);
        }
        if (gap <= WIDEST_GAP)
            row->density += gap * (points[i].density + next->density) / 2;
    }
    return true;
}

/* The variance of the height, with a tail of ω⁻⁵ beyond the table. */
static double table_variance(const spectrum_table *table)
{
    const spectrum_row *rows = table->rows, *last = &rows[table->row_count - 1];
    double sum = last->density * last->frequency / 4;
    for (size_t i = 0; i + 1 < table->row_count; i++)
        sum += (rows[i + 1].frequency - rows[i].frequency) * (rows[i].density + rows[i + 1].density) / 2;
    return sum;
}

static bool finish_table(table_reader *r)
{
    spectrum_table *table = r->table;
    const spectrum_point *highest = table->points;
    double most = 0;
    char wrong[160];
    for (size_t i = 0; i < table->row_count; i++) {
        if (!finish_row(r, &table->rows[i]))
            return false;
        most = fmax(most, table->rows[i].density);
    }
    for (size_t i = 0; i < table->point_count; i++)
        highest = table->points[i].density > highest->density ? &table->points[i] : highest;
    const char *allowed = r->column > 0 ? "densities above 0 at two frequencies at least"
                                        : "lines of frequency (Hz), direction (degrees, where waves come from) and density (m²/Hz/degree) for at least two "
                                          "frequencies";
    const char *fault = table->row_count == 0 ? "no rows" : table->row_count < 2 ? "only one frequency" : !(most > 0) ? "no waves, every density is 0" : NULL;
    if (table->row_count >= 2 && !(most > 0) && highest->density > 0)
        return refuse_at(r, highest,
                         "the table holds no waves: gaps of over 90 degrees, as on both sides of this direction, count as empty; allowed: smaller ones");
    if (fault != NULL) {
        r->line = table->row_count > 0 ? table->points[0].line : r->line;
        return refuse(r, 1, "the table holds %s; allowed: %s", fault, allowed);
    }
    const double height = sqrt(2 * table_variance(table));
    if (height > MOST_AMPLITUDE) {
        snprintf(wrong, sizeof wrong, "densities such as this one make a wave of %.6g m; allowed: waves of at most %g m", height, MOST_AMPLITUDE);
        return refuse_at(r, highest, wrong);
    }
    return true;
}

static bool parse_table(spectrum_table *out, const char *text, size_t length, const char *name, bool converted, scene_error *error)
{
    table_reader r = {.table = out, .name = name, .error = error, .line = 1, .column = converted, .per_radian = 180 / SPECTRUM_PI};
    scene_place place;
    *out = (spectrum_table){0};
    if (!scene_text_is_clean(text, length, &place)) {
        r.line = place.line;
        return refuse(&r, place.column, "not a text file: a byte that is not printable UTF-8; allowed: lines of three numbers");
    }
    if (length >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) {
        text += 3;
        length -= 3;
    }
    bool good = true;
    for (size_t at = 0; good && at < length; r.line += !converted) {
        const char *end = memchr(text + at, '\n', length - at);
        const size_t size = end != NULL ? (size_t)(end - text) - at : length - at;
        good = read_line(&r, text + at, size);
        at += size + 1;
    }
    if (good && finish_table(&r))
        return true;
    spectrum_table_free(out);
    return false;
}

bool spectrum_table_parse(spectrum_table *out, const char *text, size_t length, const char *name, scene_error *error)
{
    return parse_table(out, text, length, name, false, error);
}

bool spectrum_table_load(spectrum_table *out, const char *path, scene_error *error)
{
    size_t length;
    scene_place unused;
    *out = (spectrum_table){0};
    char *text = buoy_file_read(path, &length, error);
    if (text == NULL)
        return false;
    const buoy_format format = scene_text_is_clean(text, length, &unused) ? buoy_format_of(text) : BUOY_TABLE;
    if (format != BUOY_TABLE) {
        char *table = buoy_file_convert(format, path, text, error);
        free(text);
        if (table == NULL)
            return false;
        text = table;
        length = strlen(table);
    }
    const bool good = parse_table(out, text, length, path, format != BUOY_TABLE, error);
    free(text);
    return good;
}
