# Completion for bash: subcommands and options are asked of the program itself; other words are files.
_koshi() {
  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]:-} choices=
  if [ "$COMP_CWORD" -eq 1 ]; then
    choices=$(koshi --help 2>/dev/null | awk '/^Subcommands:/ { found = 1; next } found && /^  [a-z]/ { print $1 }')
    choices+=" --help --version"
  elif [[ $word == -* ]]; then
    choices=$(koshi "$command" --help 2>/dev/null | grep -oE -- '^ +(-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+')
  fi
  # Without choices `complete -o default` falls back to file names.
  mapfile -t COMPREPLY < <(compgen -W "$choices" -- "$word")
}
complete -o default -F _koshi koshi
