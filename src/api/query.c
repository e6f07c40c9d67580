/* SPDX-License-Identifier: MIT
 * Questions about the water at points. */
#include <math.h>

#include "api/structs.h"
#include "api/validate.h"
#include "cpu/query_lanes.h"
#include "mangata/query.h"

/* What both questions need. */
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
    return MGT_OK;
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
    if (status != MGT_OK)
        return status;
    water_terms terms;
    water_terms_at(water, time, own.least_wavelength, &terms, own.covariance);
    query_lanes().query(&terms, water->level, points, count, &own);
    return struct_give(&r, &water_answers_kind, &own, answers);
}

mgt_status mgt_water_trace(const mgt_water *water, double time, const double *rays, size_t count, double reach, double *distance)
{
    const reporter r = creation_reporter();
    const mgt_status status = check_water(&r, "mgt_water_trace", water, time);
    if (status != MGT_OK)
        return status;
    if (count > 0 && (!rays || !distance))
        return report_error(&r, MGT_ERROR_ARGUMENT, "query.rays", "mgt_water_trace: the list of %s is NULL", rays ? "distances" : "rays");
    if (!(reach >= 0 && reach <= 1e9))
        return report_error(&r, MGT_ERROR_ARGUMENT, "query.reach", "mgt_water_trace: reach is %g; allowed is 0 to 1e9", reach);
    water_terms terms;
    double unused[3];
    water_terms_at(water, time, 0, &terms, unused);
    query_lanes().trace(&terms, water->level, rays, count, reach, distance);
    return MGT_OK;
}
