/* SPDX-License-Identifier: MIT
 * The functions of mangata/query.h: queries of the water at points and along rays. */
#include <math.h>

#include "api/structs.h"
#include "api/validate.h"
#include "cpu/query_lanes.h"
#include "mangata/query.h"
#include "params/foam.h"
#include "reference/foam.h"

/* Checks the arguments that mgt_water_query() and mgt_water_trace() share. */
static mgt_status check_water(const reporter *r, const char *call, const mgt_water *water, double time)
{
    if (!water)
        return report_error(r, MGT_ERROR_ARGUMENT, "query.water", "%s: the water is NULL", call);
    if (!(fabs(time) <= 1e9))
        return report_error(r, MGT_ERROR_ARGUMENT, "query.time", "%s: the time is %g s; allowed is -1e9 to 1e9", call, time);
    if (!(fabs(water->level) <= 1e6))
        return report_error(r, MGT_ERROR_SCENE, "query.level", "water.level is %g; allowed is -1e6 to 1e6", water->level);
    if (!(water->choppiness >= 0 && water->choppiness <= 1))
        return report_error(r, MGT_ERROR_SCENE, "query.choppiness", "water.choppiness is %g; allowed is 0 to 1", (double)water->choppiness);
    return validate_waves(r, water);
}

static mgt_status check_answers(const reporter *r, const mgt_water_answers *answers)
{
    if (!(answers->least_wavelength >= 0 && answers->least_wavelength <= 1e9))
        return report_error(r, MGT_ERROR_ARGUMENT, "query.answers", "least_wavelength is %g m; allowed is 0 to 1e9", answers->least_wavelength);
    if (answers->exact > 1 || answers->reserved)
        return report_error(r, MGT_ERROR_ARGUMENT, "query.answers", "%s is %u; allowed is %s", answers->reserved ? "reserved" : "exact",
                            answers->reserved ? answers->reserved : answers->exact, answers->reserved ? "0" : "0 or 1");
    if (!(answers->foam_share >= 0 && (double)answers->foam_share <= MOST_FOAM))
        return report_error(r, MGT_ERROR_ARGUMENT, "query.answers", "foam_share is %g; allowed is 0 to %g", (double)answers->foam_share, MOST_FOAM);
    if (!(answers->foam_persistence >= 0 && answers->foam_persistence <= 60))
        return report_error(r, MGT_ERROR_ARGUMENT, "query.answers", "foam_persistence is %g s; allowed is 0 to 60", (double)answers->foam_persistence);
    return MGT_OK;
}

/* Checks the coordinates of `count` places: the first `size` of every `stride` numbers. One that is not finite is answered by NaN. */
static mgt_status check_places(const reporter *r, const char *what, const double *places, size_t count, size_t stride, size_t size)
{
    const double most = 1e9;
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < size; c++) {
            const double at = places[i * stride + c];
            if (fabs(at) > most && isfinite(at))
                return report_error(r, MGT_ERROR_ARGUMENT, "query.places", "%s %zu: coordinate %zu is %g m; allowed is -1e9 to 1e9", what, i, c, at);
        }
    return MGT_OK;
}

/* The answers with pointers to those of point `first` and the next ones. */
static mgt_water_answers answers_from(const mgt_water_answers *all, size_t first)
{
    mgt_water_answers a = *all;
    a.height = all->height ? all->height + first : NULL;
    a.normal = all->normal ? all->normal + 3 * first : NULL;
    a.velocity = all->velocity ? all->velocity + 3 * first : NULL;
    a.jacobian = all->jacobian ? all->jacobian + first : NULL;
    return a;
}

/* The arguments of a call. */
typedef struct question {
    const mgt_water *water;
    double time;
    const double *points; /* mgt_water_query() */
    mgt_water_answers *answers;
    const double *rays; /* mgt_water_trace(); NULL: the call is mgt_water_query() */
    double reach, *distance;
    size_t count; /* number of points or rays */
} question;

/* Answers a query that asks for foam. Foam belongs to the places where the points' water rests, so points are taken in blocks whose places fit on the stack. */
static void answer_with_foam(const question *q, const water_terms *terms)
{
    enum { SOME = 128 };
    double rest[2 * SOME];
    foam_sea sea;
    mgt_scene scene;
    mgt_scene_init(&scene, sizeof scene);
    scene.water = *q->water;
    scene.foam = q->answers->foam_share;
    scene.foam_persistence = q->answers->foam_persistence;
    const bool some = foam_sea_of(&scene, &sea);
    size_t unsettled = 0;
    for (size_t first = 0; first < q->count; first += SOME) {
        const size_t points_left = q->count - first, now = points_left < SOME ? points_left : SOME;
        const double *points = q->points + 2 * first;
        mgt_water_answers part = answers_from(q->answers, first);
        query_lanes().query(terms, q->water->level, points, now, &part, rest);
        unsettled += part.unsettled;
        for (size_t i = 0; i < now; i++) {
            const double here = 0 * (points[2 * i] + points[2 * i + 1]); /* 0, or NaN if the point is not finite */
            const double share = some && here == 0 ? reference_foam_at(&sea, rest[2 * i], rest[2 * i + 1], q->time).share : here;
            q->answers->foam[first + i] = (float)share;
        }
    }
    q->answers->unsettled = unsettled;
}

static void answer_by(const question *q, water_term *room)
{
    double covariance[3];
    const water_terms terms = water_terms_at(q->water, q->time, q->rays ? 0 : q->answers->least_wavelength, room, covariance);
    if (q->rays) {
        query_lanes().trace(&terms, q->water->level, q->rays, q->count, q->reach, q->distance);
        return;
    }
    for (int i = 0; i < 3; i++)
        q->answers->covariance[i] = covariance[i];
    if (q->answers->foam)
        answer_with_foam(q, &terms);
    else
        query_lanes().query(&terms, q->water->level, q->points, q->count, q->answers, NULL);
}

enum { FEW_WAVES = 512 };

static __attribute__((noinline)) void answer_few(const question *q)
{
    water_term room[FEW_WAVES];
    answer_by(q, room);
}

static __attribute__((noinline)) void answer_many(const question *q)
{
    water_term room[MGT_MAX_WAVES];
    answer_by(q, room);
}

/* The terms are on the stack, so that nothing is allocated. Seas of few waves get a smaller frame. */
static void answer(const question *q)
{
    if (q->water->wave_count <= FEW_WAVES)
        answer_few(q);
    else
        answer_many(q);
}

mgt_status mgt_water_query(const mgt_water *water, double time, const double *points, size_t count, mgt_water_answers *answers)
{
    const reporter r = creation_reporter();
    mgt_water_answers own;
    mgt_status status = struct_take(&r, &water_answers_kind, &own, answers, 1);
    if (status == MGT_OK)
        status = check_answers(&r, &own);
    if (status == MGT_OK)
        status = check_water(&r, "mgt_water_query", water, time);
    if (status == MGT_OK && count > 0 && !points)
        status = report_error(&r, MGT_ERROR_ARGUMENT, "query.points", "mgt_water_query: the list of points is NULL");
    if (status == MGT_OK)
        status = check_places(&r, "mgt_water_query: point", points, count, 2, 2);
    if (status != MGT_OK)
        return status;
    answer(&(question){.water = water, .time = time, .points = points, .answers = &own, .count = count});
    return struct_give(&r, &water_answers_kind, &own, answers);
}

mgt_status mgt_water_trace(const mgt_water *water, double time, const double *rays, size_t count, double reach, double *distance)
{
    const reporter r = creation_reporter();
    mgt_status status = check_water(&r, "mgt_water_trace", water, time);
    if (status != MGT_OK)
        return status;
    if (count > 0 && (!rays || !distance))
        return report_error(&r, MGT_ERROR_ARGUMENT, "query.rays", "mgt_water_trace: the list of %s is NULL", rays ? "distances" : "rays");
    if (!(reach >= 0 && reach <= 1e9))
        return report_error(&r, MGT_ERROR_ARGUMENT, "query.reach", "mgt_water_trace: reach is %g; allowed is 0 to 1e9", reach);
    status = check_places(&r, "mgt_water_trace: origin", rays, count, 6, 3);
    if (status == MGT_OK && count > 0)
        answer(&(question){.water = water, .time = time, .rays = rays, .count = count, .reach = reach, .distance = distance});
    return status;
}
