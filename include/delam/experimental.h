/* SPDX-License-Identifier: BSD-3-Clause
 *
 * Functions that libdelam does not promise yet: any version may change or remove them. Their names start with
 * delam_experimental_, and their version node is DELAM_EXPERIMENTAL, not that of the ABI. A function that has proved
 * itself moves to delam.h under a name of its own. The rules at the head of delam.h apply here as well. No other header
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
