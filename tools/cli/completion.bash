# Completion of warmjoint for bash: words come from the program's help and lists, files from bash where they give none.
# For one shell: source completion.bash; tools/install puts it where bash looks for it.
_warmjoint() {
  local program=${COMP_WORDS[0]} cur=${COMP_WORDS[COMP_CWORD]} i
  local command="" words="" help=""
  local at=$((COMP_CWORD - 1))
  COMPREPLY=()
  # bash parts words at '=': what stands behind one is a value of what stands before it
  [[ $cur == = ]] && cur= && at=$COMP_CWORD
  [[ ${COMP_WORDS[at]} == = ]] && ((at--))
  local before=${COMP_WORDS[at]}
  # the subcommand is the first word that is no option
  for ((i = 1; i < COMP_CWORD; i++)); do
    [[ ${COMP_WORDS[i]} != -* ]] && command=${COMP_WORDS[i]} && break
  done
  help=$("$program" $command --help 2>/dev/null)

  if [[ -z $command && $cur != -* ]]; then
    words=$(sed -n 's/^  \([a-z][a-z-]*\)  .*/\1/p' <<<"$help")
  elif [[ $cur == -* ]]; then
    words=$(grep -oE '^  -[^ ]*' <<<"$help" | tr ',' '\n')
  elif [[ $before == --identifier ]]; then
    words=$("$program" list identifiers --format names)
  elif [[ $before == law ]]; then
    words=$("$program" list laws --format names)
  elif [[ $before == -* ]]; then
    # the choices of an option stand behind its name, with | between them
    words=$(sed -nE "s/^  ([^ ]*,)?$before ([a-z][^ =]*\|[^ =]*).*/\2/p" <<<"$help" | tr '|' '\n' | grep -v '[A-Z]')
  elif [[ $command == list && $before != list ]]; then
    words=$("$program" list "$before" --format names 2>/dev/null)
  elif [[ $command == list ]]; then
    words="laws identifiers robots library suites"
  elif [[ $command == run ]]; then
    words=$("$program" list suites --format names)
  elif [[ $command == attach ]]; then
    words=$("$program" list robots --format names)
  fi
  COMPREPLY=($(compgen -W "$words" -- "$cur"))
}
complete -o default -F _warmjoint warmjoint
