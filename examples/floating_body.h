/* SPDX-License-Identifier: MIT */
/* A rigid body that floats on the rendered water: heave, pitch and roll by mgt_water_query(). docs/buoyancy.md explains it.
 *
 * The body stands as it floats at rest: y = 0 is its waterline, its bow points to -z, +x is starboard. It keeps its place and heading. */
#ifndef FLOATING_BODY_H
#define FLOATING_BODY_H

#include <mangata/mangata.h>
#include <math.h>

enum { BODY_MAX_COLUMNS = 256 };
#define BODY_GRAVITY 9.81        /* m/s² */
#define BODY_WATER_DENSITY 1000. /* kg/m³ */

/* An upright column of the hull from its bottom to its rim; what of it is below the water carries. */
typedef struct body_column {
    double x, z;        /* of its axis, metres */
    double bottom, top; /* metres over the waterline; no more water is displaced than up to the top */
    double area;        /* m² */
} body_column;

typedef struct floating_body {
    body_column columns[BODY_MAX_COLUMNS];
    size_t count;
    double mass;                        /* kg */
    double center[3];                   /* of the mass, metres */
    double pitch_inertia, roll_inertia; /* about the axes x and z through the centre, kg m² */
    double damping;                     /* force per area and speed relative to the water, N s/m³ */
    double least_wavelength;            /* metres: shorter waves do not move the body */
    double place_x, place_z;            /* of the centre in the world, metres */
    double heading;                     /* radians about the upright axis, counter-clockwise from above; 0: the bow points to -z */
} floating_body;

/* Where the body is and how it moves. Angles in radians, about the axes through the centre. */
typedef struct body_motion {
    double heave, pitch, roll; /* up from the place at rest, metres; bow up; starboard up */
    double heave_speed, pitch_speed, roll_speed;
} body_motion;

/* Gives the body the mass that makes it float at y = 0 without trim, and the inertia of a box. `center_y` is the height of its centre of mass. */
static inline void body_float_as_drawn(floating_body *body, double center_y, const double box[3])
{
    double volume = 0, moment_x = 0, moment_z = 0;
    for (size_t i = 0; i < body->count; i++) {
        const body_column *column = &body->columns[i];
        const double displaced = column->area * fmax(fmin(0, column->top) - column->bottom, 0);
        volume += displaced;
        moment_x += displaced * column->x;
        moment_z += displaced * column->z;
    }
    body->mass = BODY_WATER_DENSITY * volume;
    body->center[0] = moment_x / volume;
    body->center[1] = center_y;
    body->center[2] = moment_z / volume;
    body->pitch_inertia = body->mass * (box[1] * box[1] + box[2] * box[2]) / 12;
    body->roll_inertia = body->mass * (box[0] * box[0] + box[1] * box[1]) / 12;
}

/* From the body to the world: turned about its centre by roll, then pitch, then heading. It is the transform of mgt_object. */
static inline void body_transform(const floating_body *body, const body_motion *motion, double transform[3][4])
{
    const double ch = cos(body->heading), sh = sin(body->heading), cp = cos(motion->pitch), sp = sin(motion->pitch), cr = cos(motion->roll),
                 sr = sin(motion->roll);
    const double turn[3][3] = {{ch * cr + sh * sp * sr, sh * sp * cr - ch * sr, sh * cp},
                               {cp * sr, cp * cr, -sp},
                               {ch * sp * sr - sh * cr, sh * sr + ch * sp * cr, ch * cp}};
    const double at[3] = {body->place_x, body->center[1] + motion->heave, body->place_z};
    for (int i = 0; i < 3; i++) {
        transform[i][3] = at[i];
        for (int j = 0; j < 3; j++) {
            transform[i][j] = turn[i][j];
            transform[i][3] -= turn[i][j] * body->center[j];
        }
    }
}

static inline double body_row(const double row[4], double x, double y, double z) { return row[0] * x + row[1] * y + row[2] * z + row[3]; }

/* What moves the body: an upright force and its moments about the axes of pitch and roll. */
typedef struct body_load {
    double force, pitch_moment, roll_moment; /* N, N m */
} body_load;

/* The water at a column's place. */
typedef struct body_water {
    double height, speed; /* of the surface, upward */
    float normal[3];
} body_water;

/* Adds what a column carries, and its damping. Pressure grows along the surface's normal, so that a body lies along long waves; the part of it that is
 * not upright turns the body and moves it nowhere. */
static inline void body_add_column(const floating_body *body, const body_motion *motion, double transform[3][4], const body_column *column,
                                   const body_water *water, body_load *load)
{
    const double base = body_row(transform[1], column->x, column->bottom, column->z);
    const double wet = fmin(fmax((water->height - base) / transform[1][1], 0), column->top - column->bottom); /* along the column's axis */
    if (wet <= 0)
        return;
    const double middle = column->bottom + wet / 2, ch = cos(body->heading), sh = sin(body->heading);
    const double dx = body_row(transform[0], column->x, middle, column->z) - body->place_x;
    const double dz = body_row(transform[2], column->x, middle, column->z) - body->place_z;
    const double arm_x = ch * dx - sh * dz, arm_z = sh * dx + ch * dz;
    const double arm_y = body_row(transform[1], column->x, middle, column->z) - body->center[1] - motion->heave;
    const double rising = motion->heave_speed + motion->roll_speed * arm_x - motion->pitch_speed * arm_z;
    const double lift = BODY_WATER_DENSITY * BODY_GRAVITY * column->area * wet, force = lift - column->area * body->damping * (rising - water->speed);
    const double push_x = lift * (ch * water->normal[0] - sh * water->normal[2]) / water->normal[1];
    const double push_z = lift * (sh * water->normal[0] + ch * water->normal[2]) / water->normal[1];
    load->force += force;
    load->pitch_moment += arm_y * push_z - arm_z * force;
    load->roll_moment += arm_x * force - arm_y * push_x;
}

/* The loads of all columns on the water at `time`. */
static inline mgt_status body_loads(const floating_body *body, const body_motion *motion, const mgt_water *water, double time, body_load *load)
{
    double transform[3][4], points[2 * BODY_MAX_COLUMNS], height[BODY_MAX_COLUMNS];
    float normal[3 * BODY_MAX_COLUMNS], velocity[3 * BODY_MAX_COLUMNS];
    body_transform(body, motion, transform);
    for (size_t i = 0; i < body->count; i++) {
        const body_column *column = &body->columns[i];
        points[2 * i] = body_row(transform[0], column->x, 0, column->z);
        points[2 * i + 1] = body_row(transform[2], column->x, 0, column->z);
    }
    mgt_water_answers answers;
    mgt_water_answers_init(&answers, sizeof answers);
    answers.height = height;
    answers.normal = normal;
    answers.velocity = velocity;
    answers.least_wavelength = body->least_wavelength;
    const mgt_status status = mgt_water_query(water, time, points, body->count, &answers);
    *load = (body_load){.force = -BODY_GRAVITY * body->mass};
    for (size_t i = 0; status == MGT_OK && i < body->count; i++) {
        const body_water here = {height[i], velocity[3 * i + 1], {normal[3 * i], normal[3 * i + 1], normal[3 * i + 2]}};
        body_add_column(body, motion, transform, &body->columns[i], &here, load);
    }
    return status;
}

/* One step of semi-implicit Euler from `time`: speeds first, then places by the new speeds. */
static inline mgt_status body_step(const floating_body *body, body_motion *motion, const mgt_water *water, double time, double step)
{
    body_load load;
    const mgt_status status = body_loads(body, motion, water, time, &load);
    if (status != MGT_OK)
        return status;
    motion->heave_speed += step * load.force / body->mass;
    motion->pitch_speed += step * load.pitch_moment / body->pitch_inertia;
    motion->roll_speed += step * load.roll_moment / body->roll_inertia;
    motion->heave += step * motion->heave_speed;
    motion->pitch += step * motion->pitch_speed;
    motion->roll += step * motion->roll_speed;
    return MGT_OK;
}

/* Moves the body on by `seconds`, in steps of 1/240 s at most. */
static inline mgt_status body_run(const floating_body *body, body_motion *motion, const mgt_water *water, double time, double seconds)
{
    const int steps = (int)ceil(240 * seconds);
    mgt_status status = MGT_OK;
    for (int i = 0; status == MGT_OK && i < steps; i++)
        status = body_step(body, motion, water, time + seconds * i / steps, seconds / steps);
    return status;
}
#endif
