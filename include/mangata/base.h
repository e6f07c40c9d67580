/* SPDX-License-Identifier: MIT
 *
 * What every header of Mangata needs: how symbols are exported, versions, limits, statuses. */
#ifndef MANGATA_BASE_H
#define MANGATA_BASE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Windows: define MGT_STATIC where the static library is used; pkg-config --static and the CMake target mangata::mangata_static do. */
#if defined(_WIN32) && defined(MGT_STATIC)
#define MGT_API
#elif defined(_WIN32) && defined(MGT_BUILDING) /* the library itself */
#define MGT_API __declspec(dllexport)
#elif defined(_WIN32)
#define MGT_API __declspec(dllimport)
#else
#define MGT_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define MGT_VERSION_MAJOR 0
#define MGT_VERSION_MINOR 1
#define MGT_VERSION_PATCH 0
#define MGT_VERSION_STRING "0.1.0"

/* Limits that are checked. */
#define MGT_MAX_WAVES 2048
#define MGT_MAX_OBJECTS 65536
#define MGT_MAX_TRIANGLES 67108864 /* of a mesh, and of all objects of a scene together */
#define MGT_MAX_IMAGE_SIDE 32768

typedef enum mgt_status {
    MGT_OK = 0,
    MGT_ERROR_ARGUMENT,    /* a pointer, size or enum that makes no call possible */
    MGT_ERROR_SCENE,       /* a scene value out of its range; mgt_last_error() names the field */
    MGT_ERROR_MEMORY,      /* an allocation failed */
    MGT_ERROR_UNAVAILABLE, /* the backend or instruction set does not exist here */
    MGT_ERROR_UNSUPPORTED, /* valid, but no backend can do it */
    MGT_ERROR_THREAD,      /* a thread could not be started */
    MGT_CANCELLED,         /* the progress callback asked to stop */
    MGT_ERROR_LOST         /* OpenGL: the device was reset and its context with it; a new context may work */
} mgt_status;

/* Names of enum values, here and in the other headers. mgt_x_name() returns the static word that commands and files use, or NULL for a number that is no
 * value of the enum. Values count up from 0, so the first NULL ends a list; only mgt_mixture has gaps. mgt_x_from_name() returns false and writes nothing
 * where there is no such name. */
MGT_API const char *mgt_status_name(mgt_status status);
MGT_API bool mgt_status_from_name(const char *name, mgt_status *status);

/* Lower-case English text for a status; never NULL. */
MGT_API const char *mgt_status_text(mgt_status status);

/* Version of the library in use, "major.minor.patch". */
MGT_API const char *mgt_version(void);

#ifdef __cplusplus
}
#endif
#endif
