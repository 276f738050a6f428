# bash completion of colmap-vcarve: options from its help, files otherwise
_colmap_vcarve()
{
    local command=${COMP_WORDS[1]}
    [[ $command == compare || $command == texture ]] || command=
    COMPREPLY=()
    [[ $2 == -* ]] || return
    COMPREPLY=($(compgen -W "$("$1" $command --help-all | grep -oE '^  (-., )?--[a-z-]+' |
        grep -oE -- '--.*')" -- "$2"))
}
complete -o bashdefault -o default -F _colmap_vcarve colmap-vcarve
