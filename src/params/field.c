/* SPDX-License-Identifier: MIT
 *
 * Ranges, texts and comparisons of single rows.
 */
#include "params/field.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Shortens "1e+09" to "1e9", which JSON and YAML read, too. */
static void shorten_exponent(char *text)
{
    char *exponent = strchr(text, 'e');
    if (exponent == NULL)
        return;
    char *to = exponent + 1, *from = to;
    if (*from == '-')
        to++;
    from++; /* printf always writes a sign */
    while (*from == '0')
        from++;
    memmove(to, from, strlen(from) + 1);
}

short_number double_text(double value)
{
    short_number number;
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(number.text, sizeof number.text, "%.*g", digits, value);
        if (strtod(number.text, NULL) == value)
            break;
    }
    shorten_exponent(number.text);
    return number;
}

short_number float_text(float value)
{
    short_number number;
    for (int digits = 6; digits <= 9; digits++) {
        snprintf(number.text, sizeof number.text, "%.*g", digits, (double)value);
        if (strtof(number.text, NULL) == value)
            break;
    }
    shorten_exponent(number.text);
    return number;
}

static const char *skip_digits(const char *text) { return text + strspn(text, "0123456789"); }

/* Whether the whole text is a decimal number. strtod() alone would also accept "nan", "1e" or " 3". */
static bool is_decimal(const char *text)
{
    text += *text == '-' || *text == '+';
    const char *whole = skip_digits(text), *end = whole;
    bool digits = whole > text;
    if (*end == '.') {
        const char *fraction = skip_digits(end + 1);
        digits |= fraction > end + 1;
        end = fraction;
    }
    if (digits && (*end == 'e' || *end == 'E')) {
        const char *exponent = end + 1 + (end[1] == '-' || end[1] == '+');
        end = skip_digits(exponent);
        digits = end > exponent;
    }
    return digits && *end == '\0';
}

/* Reads a whole number without a sign: digits, 0x with hexadecimal ones or 0o with octal ones. False: it is none, or not below 2^64. */
static bool read_whole(const char *text, uint64_t *value)
{
    const bool prefixed = text[0] == '0' && (text[1] == 'x' || text[1] == 'o');
    const int base = !prefixed ? 10 : text[1] == 'x' ? 16 : 8;
    const char *first = prefixed ? text + 2 : text;
    if (!*first || first[strspn(first, base == 16 ? "0123456789abcdefABCDEF" : base == 8 ? "01234567" : "0123456789")] != '\0')
        return false;
    errno = 0;
    *value = strtoull(first, NULL, base);
    return errno == 0;
}

bool number_read(const char *text, double *value)
{
    uint64_t whole;
    if (is_decimal(text)) {
        *value = strtod(text, NULL);
        return true;
    }
    if (strcasecmp(text + (*text == '-' || *text == '+'), ".inf") == 0 || strcasecmp(text, ".nan") == 0) {
        *value = NAN;
        return true;
    }
    if (!read_whole(text, &whole))
        return false;
    *value = (double)whole;
    return true;
}

/* ---- single values ---------------------------------------------------------------------------------------- */

size_t field_size(const field_row *field)
{
    switch (field->type) {
    case FIELD_COUNT:
        return sizeof(uint32_t);
    case FIELD_LARGE:
        return sizeof(uint64_t);
    case FIELD_NUMBER:
        return sizeof(double);
    case FIELD_FLOAT:
        return sizeof(float);
    case FIELD_VECTOR:
    case FIELD_SCALE:
        return 3 * sizeof(double);
    case FIELD_COLOR:
        return 3 * sizeof(float);
    case FIELD_CHOICE:
        return sizeof(int);
    case FIELD_SWITCH:
        return sizeof(bool);
    case FIELD_TEXT:
    case FIELD_EXPOSURE:
    case FIELD_MAPPING:
    case FIELD_LIST:
        break;
    }
    return 0;
}

int field_place(const field_row *field, const void *value)
{
    const int number = field->type == FIELD_SWITCH ? *(const bool *)value : *(const int *)value;
    for (int i = 0; field_word(field, i); i++)
        if ((field->values ? field->values[i] : i) == number)
            return i;
    return -1;
}

int field_word_count(const field_row *field)
{
    int count = 0;
    while (field_word(field, count))
        count++;
    return count;
}

void field_choose(const field_row *field, int place, void *value)
{
    if (field->type == FIELD_SWITCH)
        *(bool *)value = place != 0;
    else
        *(int *)value = field->values ? field->values[place] : place;
}

/* Reads a whole number of up to 64 bits. Where it has neither fraction nor exponent it is not read as a double, which would round it. */
static bool parse_large(const field_row *field, const char *text, uint64_t *value)
{
    double number;
    if (!number_read(text, &number) || !field_in_range(field, number))
        return false;
    if (read_whole(text, value))
        return true;
    if (!(number < 18446744073709551616.0)) /* 2^64, the nearest double to 2^64 - 1 */
        return false;
    *value = (uint64_t)number;
    return true;
}

const char *name_first(const name_alias *aliases, const char *word)
{
    for (; aliases && aliases->alias; aliases++)
        if (strcmp(aliases->alias, word) == 0)
            return aliases->name;
    return word;
}

const char *field_word_alias(const field_row *field, int place)
{
    for (const name_alias *other = field->aliases; other && other->alias; other++)
        if (strcmp(other->name, field_word(field, place)) == 0)
            return other->alias;
    return NULL;
}

bool field_parse(const field_row *field, const char *text, void *value)
{
    static const char *const truth[] = {"false", "true"};
    double number;
    uint64_t large;
    switch (field->type) {
    case FIELD_CHOICE:
    case FIELD_SWITCH:
        text = name_first(field->aliases, text);
        for (int i = 0; field_word(field, i); i++)
            if (strcmp(text, field_word(field, i)) == 0 || (field->type == FIELD_SWITCH && strcmp(text, truth[i]) == 0)) {
                field_choose(field, i, value);
                return true;
            }
        return false;
    case FIELD_LARGE:
        if (!parse_large(field, text, &large))
            return false;
        *(uint64_t *)value = large;
        return true;
    case FIELD_COUNT:
    case FIELD_NUMBER:
    case FIELD_FLOAT:
        if (!number_read(text, &number) || !field_in_range(field, number))
            return false;
        if (field->type == FIELD_COUNT)
            *(uint32_t *)value = (uint32_t)number;
        else if (field->type == FIELD_NUMBER)
            *(double *)value = number;
        else
            *(float *)value = (float)number;
        return true;
    default:
        return false;
    }
}

static double number_at(const field_row *field, const void *value)
{
    return field->type == FIELD_COUNT   ? *(const uint32_t *)value
           : field->type == FIELD_LARGE ? (double)*(const uint64_t *)value
           : field->type == FIELD_FLOAT ? (double)*(const float *)value
                                        : *(const double *)value;
}

static double component(const field_row *field, const void *value, int i)
{
    return field->type == FIELD_COLOR ? (double)((const float *)value)[i] : ((const double *)value)[i];
}

static bool is_triple(const field_row *field) { return field->type == FIELD_VECTOR || field->type == FIELD_SCALE || field->type == FIELD_COLOR; }

bool field_is_legal(const field_row *field, const void *value)
{
    bool legal = true;
    if (field->choices)
        return field_place(field, value) >= 0;
    for (int i = 0; i < 3 && is_triple(field); i++)
        legal &= field_in_range(field, component(field, value, i));
    return is_triple(field) ? legal : field_in_range(field, number_at(field, value));
}

bool fields_equal(const field_row *fields, const void *a, const void *b)
{
    for (const field_row *field = fields; field->key; field++) {
        const void *left = field_at(field, a), *right = field_at(field, b);
        if (field->type == FIELD_MAPPING ? !fields_equal(field->fields, left, right) : memcmp(left, right, field_size(field)) != 0)
            return false;
    }
    return true;
}

short_number field_print(const field_row *field, const void *value)
{
    short_number out;
    if (field->type == FIELD_CHOICE || field->type == FIELD_SWITCH) {
        const int place = field_place(field, value);
        snprintf(out.text, sizeof out.text, "%s", place >= 0 ? field_word(field, place) : "");
        if (place < 0)
            snprintf(out.text, sizeof out.text, "%d", *(const int *)value);
        return out;
    }
    if (is_triple(field)) {
        snprintf(out.text, sizeof out.text, "[%g, %g, %g]", component(field, value, 0), component(field, value, 1), component(field, value, 2));
        return out;
    }
    if (field->type == FIELD_FLOAT)
        return float_text(*(const float *)value);
    if (field->type != FIELD_LARGE)
        return double_text(number_at(field, value));
    snprintf(out.text, sizeof out.text, "%llu", (unsigned long long)*(const uint64_t *)value);
    return out;
}

/* ---- conditions --------------------------------------------------------------------------------------------- */

enum { CONDITIONS = sizeof((field_row *)0)->when / sizeof *((field_row *)0)->when };

static bool is_word(const char *word, const char *text, size_t length) { return strlen(word) == length && memcmp(word, text, length) == 0; }

bool field_is_alias(const field_row *field, const char *key, size_t length) { return field->alias && is_word(field->alias, key, length); }

const field_row *field_find(const field_row *fields, const char *key, size_t length)
{
    for (const field_row *field = fields; field && field->key; field++)
        if (is_word(field->key, key, length) || field_is_alias(field, key, length))
            return field;
    return NULL;
}

bool field_applies(const field_row *fields, const field_row *field, const void *parent, bool tolerant)
{
    for (int i = 0; i < CONDITIONS && field->when[i].key; i++) {
        const field_row *other = field_find(fields, field->when[i].key, strlen(field->when[i].key));
        const int place = field_place(other, field_at(other, parent));
        if (!(tolerant && field->when[i].tolerated) && (place < 0 || !(field->when[i].choices >> place & 1)))
            return false;
    }
    return true;
}

void field_conditions(const field_row *fields, const field_row *field, char *out, size_t size)
{
    size_t used = 0;
    out[0] = 0;
    for (int i = 0; i < CONDITIONS && field->when[i].key; i++) {
        const field_row *other = field_find(fields, field->when[i].key, strlen(field->when[i].key));
        uint64_t left = field->when[i].choices;
        used += (size_t)snprintf(out + used, size - used, "%s%s", i ? " and " : "", other->key);
        for (int k = 0, first = 1; left && used < size; k++, left >>= 1)
            if (left & 1) {
                used += (size_t)snprintf(out + used, size - used, "%s%s", first ? " " : left == 1 ? " or " : ", ", field_word(other, k));
                first = 0;
            }
    }
}

void field_meaning(const field_row *fields, const field_row *field, char *out, size_t size)
{
    char when[160];
    field_conditions(fields, field, when, sizeof when);
    snprintf(out, size, "%s%s%s%s%s%s%s%s", field->doc, when[0] ? " (" : "", when, when[0] ? ")" : "", field->absent ? "; by default " : "",
             field->absent ? field->absent : "", field->alias ? "; also called " : "", field->alias ? field->alias : "");
}

bool field_numbers_write(FILE *stream, const field_row *field, const void *value)
{
    const double *scales = value;
    switch (field->type) {
    case FIELD_COUNT:
    case FIELD_LARGE:
    case FIELD_NUMBER:
    case FIELD_FLOAT:
        fputs(field_print(field, value).text, stream);
        return true;
    case FIELD_SCALE:
        if (scales[0] == scales[1] && scales[0] == scales[2]) {
            fputs(double_text(scales[0]).text, stream);
            return true;
        }
        /* fall through */
    case FIELD_VECTOR:
    case FIELD_COLOR:
        for (int i = 0; i < 3; i++) {
            const short_number number = field->type != FIELD_COLOR ? double_text(((const double *)value)[i]) : float_text(((const float *)value)[i]);
            fprintf(stream, "%s%s", i == 0 ? "[" : ", ", number.text);
        }
        fputc(']', stream);
        return true;
    default:
        return false;
    }
}

bool field_in_range(const field_row *field, double value)
{
    const bool above = field->flags & FIELD_OPEN_MIN ? value > field->min : value >= field->min;
    const bool below = field->flags & FIELD_OPEN_MAX ? value < field->max : value <= field->max;
    const bool whole = (field->type != FIELD_COUNT && field->type != FIELD_LARGE) || value == floor(value);
    return whole && ((above && below) || (value == 0 && field->flags & FIELD_OR_ZERO));
}

/* Writes the range of a number and its unit: "-90 to 90 degrees". */
static void print_range(const field_row *field, char *out, size_t size)
{
    short_number low = double_text(field->min), high = double_text(field->max);
    /* The largest number of 64 bits is not representable as a double. */
    const char *min = low.text, *max = field->type == FIELD_LARGE && field->max >= 0x1p64 ? "18446744073709551615" : high.text;
    const char *space = field->unit != NULL ? " " : "", *unit = field->unit != NULL ? field->unit : "";
    if (field->min == field->max)
        snprintf(out, size, "%s", min);
    else if (field->flags & (FIELD_OPEN_MIN | FIELD_OPEN_MAX))
        snprintf(out, size, "%s %s and %s %s%s%s", field->flags & FIELD_OPEN_MIN ? "above" : "at least", min,
                 field->flags & FIELD_OPEN_MAX ? "below" : "at most", max, space, unit);
    else
        snprintf(out, size, "%s%s to %s%s%s", field->flags & FIELD_OR_ZERO && field->min > 0 ? "0 or " : "", min, max, space, unit);
}

void field_allowed(const field_row *field, char *out, size_t size)
{
    char range[160];
    print_range(field, range, sizeof range);
    size_t used;
    switch (field->type) {
    case FIELD_COUNT:
    case FIELD_LARGE:
        snprintf(out, size, field->min == field->max ? "%s" : "a whole number, %s", range);
        break;
    case FIELD_NUMBER:
    case FIELD_FLOAT:
        snprintf(out, size, "a number, %s", range);
        break;
    case FIELD_VECTOR:
        snprintf(out, size, "a list of 3 numbers [x, y, z], each %s", range);
        break;
    case FIELD_SCALE:
        snprintf(out, size, "a number, or a list of 3 numbers [x, y, z], each %s", range);
        break;
    case FIELD_COLOR:
        snprintf(out, size, "a list of 3 numbers [r, g, b], each %s", range);
        break;
    case FIELD_EXPOSURE:
        snprintf(out, size, "auto or a number, %s", range);
        break;
    case FIELD_TEXT:
        snprintf(out, size, "text");
        break;
    case FIELD_CHOICE:
    case FIELD_SWITCH:
        used = (size_t)snprintf(out, size, "one of");
        for (int i = 0; field_word(field, i) != NULL && used < size; i++) {
            const char *alias = field_word_alias(field, i);
            used += (size_t)snprintf(out + used, size - used, "%s %s%s%s%s", i > 0 ? "," : "", field_word(field, i), alias ? " (also called " : "",
                                     alias ? alias : "", alias ? ")" : "");
        }
        break;
    case FIELD_MAPPING:
        used = 0;
        if (field->flags & FIELD_SHORT) {
            field_allowed(field->fields, out, size);
            used = strlen(out);
        }
        snprintf(out + used, size - used, "%sa mapping {key: value, ...}", used > 0 ? ", or " : "");
        break;
    case FIELD_LIST:
        snprintf(out, size, "a list of at most %zu mappings", field->max_items);
        break;
    }
}

void field_allowed_text(const field_row *field, char *out, size_t size)
{
    field_allowed(field, out, size);
    const size_t used = strlen(out);
    if (field->also != NULL)
        snprintf(out + used, size - used, ", or %s", field->also->words);
}
