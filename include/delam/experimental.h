/* SPDX-License-Identifier: BSD-3-Clause
 *
 * What libdelam does not promise yet: functions that may change or go with any version, under the version node
 * DELAM_EXPERIMENTAL and not that of the ABI. Their names start with delam_experimental_. A function that has proved
 * itself moves to delam.h under a name of its own. The rules at the head of delam.h hold here too. No other header
 * includes this one.
 */
#ifndef DELAM_EXPERIMENTAL_H
#define DELAM_EXPERIMENTAL_H

#include <delam/delam.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifdef __cplusplus
}
#endif
#endif
