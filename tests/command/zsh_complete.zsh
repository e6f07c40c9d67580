# SPDX-License-Identifier: MIT
# Prints what zsh offers for each line of its input: zsh -f zsh_complete.zsh FOLDER_OF_COMPLETIONS <LINES. Before the offers of a line stands "LINE: " and the line.
# A terminal of zsh's own runs an interactive shell, whose `compadd` tells every match before it takes it.
zmodload zsh/zpty
zpty shell env TERM=dumb PS1= PS2= RPS1= zsh -f -i
say() { zpty -w shell "$1" }
say 'unsetopt zle_bracketed_paste prompt_cr prompt_sp; stty -echo; LISTMAX=10000 PROMPT='
say "fpath=(${(q)1:A} \$fpath); autoload -Uz compinit; compinit -u -D"
say 'compadd() {
  local -a offered
  if [[ " $* " == *" -"[OAD]" "* ]]; then builtin compadd "$@"; return; fi
  builtin compadd -A offered "$@"
  print -rl -- "OFFER:"${^offered}
  builtin compadd "$@"
}'
say 'bindkey "^I" complete-word; zstyle ":completion:*" completer _complete; zstyle ":completion:*" verbose no'
say 'show() { print -r -- "DONE:" }; zle -N show; bindkey "^X" show; print READY'
wait_for() { # prints what came before it
  local text all=
  repeat 400; do
    if zpty -rt shell text; then all+=$text; [[ $text == *$1* ]] && break
    else sleep 0.02; fi
  done
  REPLY=$all
}
wait_for READY
while IFS= read -r line; do
  print -r -- "LINE: $line"
  zpty -wn shell "$line"$'\t\x18'
  wait_for DONE:
  print -r -- "$REPLY" | tr '\r' '\n' | sed -n 's/.*OFFER://p' | sort -u
  zpty -wn shell $'\x15'
done
zpty -d shell
