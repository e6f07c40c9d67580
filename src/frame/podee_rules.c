/* SPDX-License-Identifier: MIT
 * Scheme podee of method adaptive: the numbers that the paper leaves to its user (docs/adaptive.md). */
#include "frame/podee_rules.h"

podee_rules podee_rules_of(const mgt_quality *q)
{
    return (podee_rules){.center = q->importance_center != 0 ? q->importance_center : 0.1,
                         .width = q->importance_width != 0 ? q->importance_width : 0.04,
                         .threshold = q->importance_threshold != 0 ? q->importance_threshold : 0.05};
}

double podee_samples_of(const mgt_quality *q) { return q->samples > 0 ? q->samples : 8; }
