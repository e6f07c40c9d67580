/* SPDX-License-Identifier: MIT
 * Questions about the water at points. */
#include <math.h>

#include "api/structs.h"
#include "api/validate.h"
#include "cpu/query_lanes.h"
#include "mangata/query.h"

static mgt_status check(const reporter *r, const mgt_water *water, double time, const double *points, size_t count, const mgt_water_answers *answers)
{
    if (!water || (count > 0 && !points))
        return report_error(r, MGT_ERROR_ARGUMENT, "query.points", "mgt_water_query: %s is NULL", water ? "the list of points" : "the water");
    if (!(fabs(time) <= 1e9))
        return report_error(r, MGT_ERROR_ARGUMENT, "query.time", "mgt_water_query: the time is %g s; allowed is -1e9 to 1e9", time);
    if (!(answers->least_wavelength >= 0 && answers->least_wavelength <= 1e9))
        return report_error(r, MGT_ERROR_ARGUMENT, "query.answers", "least_wavelength is %g m; allowed is 0 to 1e9", answers->least_wavelength);
    if (answers->exact > 1 || answers->reserved)
        return report_error(r, MGT_ERROR_ARGUMENT, "query.answers", "%s is %u; allowed is %s", answers->reserved ? "reserved" : "exact",
                            answers->reserved ? answers->reserved : answers->exact, answers->reserved ? "0" : "0 or 1");
    if (!(fabs(water->level) <= 1e6))
        return report_error(r, MGT_ERROR_SCENE, "query.level", "water.level is %g; allowed is -1e6 to 1e6", water->level);
    return validate_waves(r, water);
}

mgt_status mgt_water_query(const mgt_water *water, double time, const double *points, size_t count, mgt_water_answers *answers)
{
    const reporter r = creation_reporter();
    mgt_water_answers own;
    mgt_status status = struct_take(&r, &water_answers_kind, &own, answers, 1);
    if (status == MGT_OK)
        status = check(&r, water, time, points, count, &own);
    if (status != MGT_OK)
        return status;
    water_terms terms;
    water_terms_at(water, time, own.least_wavelength, &terms, own.covariance);
    query_lanes()(&terms, water->level, points, count, &own);
    return struct_give(&r, &water_answers_kind, &own, answers);
}
