#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs Julia into a separate folder, for machines without it: Debian 12 has no package. Debian
# 11's Julia 1.5.3 runs there if it finds the libraries of Debian 11 first, above all libunwind:
# with a newer one, every exception ends the process. Nothing outside the folder changes, and apt
# verifies the packages as usual.
# usage: scripts/setup_julia.sh FOLDER     (then run FOLDER/bin/julia)
set -euo pipefail
folder=${1:?usage: scripts/setup_julia.sh FOLDER}
release=bullseye
keys=/usr/share/keyrings/debian-archive-keyring.gpg
packages=(julia julia-common libjulia1 libjulia-openblas64 libdsfmt-19937-1 libffi7 libgit2-1.1
  libhttp-parser2.9 libllvm9 libmbedcrypto3 libmbedtls12 libmbedx509-0 libmpfr6 libopenlibm3
  libpcre2-8-0 libssh2-1 libssl1.1 libunwind8 libutf8proc2)

fail() {
  echo "setup_julia.sh: $*" >&2
  exit 1
}

if ! command -v apt-get > /dev/null || ! [ -e "$keys" ]; then
  fail "works with Debian's apt-get only"
fi

# The mirror that this machine's apt gets the main archive from.
# shellcheck disable=SC2016  # apt's own variables
mirror=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
  awk '$3 == "main" && $1 ~ /\/debian\/?$/ && $2 !~ /-/ { print $1; exit }')
[ -n "$mirror" ] || fail "apt knows no mirror of Debian's archive"

# A separate apt configuration with its own lists, so that those of the machine stay unchanged.
work=$(mktemp -d)
trap 'rm -rf "$work" "$folder.new"' EXIT
mkdir -p "$work"/{parts,lists/partial,cache/archives/partial,debs}
touch "$work/status"
echo "deb [signed-by=$keys] $mirror $release main" > "$work/sources.list"
private_apt() {
  apt-get -qq -o Dir::Etc::SourceList="$work/sources.list" -o Dir::Etc::SourceParts="$work/parts" \
    -o Dir::State::Lists="$work/lists" -o Dir::State::status="$work/status" \
    -o Dir::Cache="$work/cache" -o APT::Sandbox::User="$(id -un)" "$@"
}
private_apt update || fail "cannot reach $release"
(cd "$work/debs" && private_apt download "${packages[@]}") || fail "cannot download ${packages[*]}"

# Created in a temporary folder and moved, so that the folder exists only when it is complete.
mkdir -p "$folder.new/bin"
for deb in "$work"/debs/*.deb; do dpkg-deb -x "$deb" "$folder.new"; done
cat > "$folder.new/bin/julia" << 'WRAPPER'
#!/bin/sh
root=$(dirname "$(dirname "$(readlink -f "$0")")")
for libraries in "$root"/usr/lib/*-linux-gnu; do :; done
own=$libraries:$libraries/julia:$root/lib/$(basename "$libraries")
export LD_LIBRARY_PATH="$own${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
exec "$root/usr/bin/julia" "$@"
WRAPPER
chmod +x "$folder.new/bin/julia"
"$folder.new/bin/julia" --startup-file=no -e 'try error("x") catch end; VERSION' ||
  fail "the Julia of $release does not run here"
rm -rf "$folder"
mv "$folder.new" "$folder"
