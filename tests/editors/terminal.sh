# A terminal of its own for an editor: keys go in, the screen is read. Sourced by the suites
# of editors that live in a terminal; they set `work`, a folder that is removed at the end.

work=$(mktemp -d)
terminal=(tmux -L "gradus-$$" -f /dev/null)
trap '"${terminal[@]}" kill-server 2>/dev/null || true; rm -rf "$work"' EXIT

passed=0
pass() { passed=$((passed + 1)); printf 'ok   %s\n' "$1"; }
fail() { printf 'FAIL %s; on the screen:\n' "$1"; screen; exit 1; }

screen() { "${terminal[@]}" capture-pane -p 2>/dev/null || true; }
keys() { "${terminal[@]}" send-keys "$@"; }
keep_screen() { screen > "$GRADUS_EDITORS/screenshots/$1.txt"; }

# start EDITOR OPTION...: in the folder, with gradus in PATH
start() {
  mkdir -p "$work/bin"
  ln -s "$GRADUS" "$work/bin/gradus"
  "${terminal[@]}" new-session -d -x 140 -y 40 \
    "cd '$work' && PATH='$work/bin:$PATH' TERM=tmux-256color $(printf '%q ' "$@")"
}

# soon MILLISECONDS COMMAND...: whether a command succeeds within that time
soon() {
  local rounds=$(($1 / 50))
  shift
  for _ in $(seq "$rounds"); do
    if "$@"; then return 0; fi
    sleep 0.05
  done
  return 1
}
on_screen() { screen | grep -qF -- "$1"; }
shows() { soon 15000 on_screen "$1" || fail "waited in vain for $1"; }

# press_until TEXT KEY...: a key can be lost while a popup is closing, so it is pressed again
press_until() {
  local wanted=$1
  shift
  for _ in 1 2 3 4 5 6; do
    keys "$@"
    if soon 3000 on_screen "$wanted"; then return; fi
    keys Escape
    sleep 0.3
  done
  fail "no $wanted after $*"
}

holds() { grep -qsF -- "$2" "$1"; }

# The spec that the command line writes for the same decision.
same_as_command_line() {
  soon 10000 holds "$work/tank.grafcet" '//! accept v1 -> v2 & h & m' || fail 'the spec holds no decision'
  "$GRADUS" convert "$work/tank.ladder" -o - --accept 'v1->v2&h&m' > "$work/expected" 2>/dev/null
  diff "$work/expected" "$work/tank.grafcet"
}
