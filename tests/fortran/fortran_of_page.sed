# SPDX-License-Identifier: BSD-3-Clause
# The blocks of a page that are marked ```fortran (sed -n -f).
/^```fortran$/,/^```$/{
/^```/!p
}
