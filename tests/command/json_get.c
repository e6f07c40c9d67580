/* SPDX-License-Identifier: MIT */
/* Reads JSON from standard input and prints the value at a path such as "files.0.path"; fails when the text is not JSON or has
 * no such value. `json_get --lines KEY` does so for each line. */
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const json_t *find(const json_t *value, const char *path)
{
    char word[256];
    while (value && *path) {
        const size_t length = strcspn(path, ".");
        snprintf(word, sizeof word, "%.*s", (int)length, path);
        value = json_is_array(value) ? json_array_get(value, (size_t)strtoul(word, NULL, 10)) : json_object_get(value, word);
        path += length + (path[length] == '.');
    }
    return value;
}

static int print_value(const json_t *root, const char *path)
{
    const json_t *value = find(root, path);
    if (!value)
        return 1;
    if (json_is_string(value))
        puts(json_string_value(value));
    else if (json_is_array(value))
        printf("%zu\n", json_array_size(value));
    else {
        char *text = json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT);
        puts(text ? text : "?");
        free(text);
    }
    return 0;
}

int main(int argc, char **argv)
{
    const int lines = argc == 3 && strcmp(argv[1], "--lines") == 0;
    if (argc != 2 && !lines)
        return 64;
    json_error_t error;
    if (!lines) {
        json_t *root = json_loadf(stdin, 0, &error);
        const int failed = root ? print_value(root, argv[1]) : 1;
        json_decref(root);
        return failed;
    }
    char line[8192];
    int count = 0, failed = 0;
    while (fgets(line, sizeof line, stdin)) {
        json_t *root = json_loads(line, 0, &error);
        failed |= root ? print_value(root, argv[2]) : 1;
        json_decref(root);
        count++;
    }
    return failed || count == 0;
}
