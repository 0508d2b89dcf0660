// The C interface: no thought of its own, each function is one of C++. What is there for float and for double is
// written once, in the files of both/ that are included twice here: C(name) is pierce_name_f, then pierce_name_d.
#include <pierce/pierce_c.h>

#include <algorithm>
#include <optional>
#include <string>

#include <c/answers.h>
#include <c/given.h>
#include <c/layout.h>
#include <c/options.h>
#include <pierce/pierce.h>

using namespace pierce;
using namespace pierce::detail;

extern "C" {

const char* pierce_status_text(pierce_status status) {
    const int number = number_of(status);
    if (number < PIERCE_OK || number > PIERCE_FAILED) return "";
    return to_string(static_cast<Status>(number)).data();  // a literal: a 0 is behind it
}

const char* pierce_last_message(void) { return last_message().c_str(); }

int pierce_version(void) { return PIERCE_VERSION; }

#define SCALAR float
#define C(name) pierce_##name##_f
#include <c/both/mesh.h>  // has the handles

#include <c/both/batches.h>
#include <c/both/point_batches.h>
#include <c/both/queries.h>
#include <c/both/regions.h>
#undef SCALAR
#undef C

#define SCALAR double
#define C(name) pierce_##name##_d
#include <c/both/mesh.h>  // has the handles

#include <c/both/batches.h>
#include <c/both/point_batches.h>
#include <c/both/queries.h>
#include <c/both/regions.h>
#undef SCALAR
#undef C
}
