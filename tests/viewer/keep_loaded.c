/* SPDX-License-Identifier: MIT */
/* Loaded before all else when leaks are looked for: libraries stay, so that what they leaked can be told by their names. */
int dlclose(void *handle);

__attribute__((visibility("default"))) int dlclose(void *handle)
{
    (void)handle;
    return 0;
}
