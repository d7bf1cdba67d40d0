
# Completes by names that furrow lists, where a command or an option takes one and the functions above find nothing.
# Words are those between blanks: bash also divides them at the colons of ids of devices.
_complete_furrow_names() {
    _complete_furrow "$@"
    local line=${COMP_LINE:0:COMP_POINT} list= name before=
    local words=($line)
    [[ $line != *[[:space:]] ]] || words+=("")
    local count=${#words[@]} cur=${words[${#words[@]}-1]}
    if ((count == 2)) && [[ bench == "$cur"* ]]; then COMPREPLY+=(bench); fi
    [[ ${#COMPREPLY[@]} == 0 && $cur != -* ]] || return 0
    case ${words[count-2]} in
        --mission) list="mission list" ;;
        --domain) list="domain list" ;;
        --template) list="template list" ;;
        --device) list="device list" ;;
        --topic) list="topic list" ;;
        -[fwy] | --follow | --force | --wait | --watch | --yes) ;; # they have no value
        -*) return 0 ;;
    esac
    if [[ -z $list ]]; then
        ((count > 3)) || return 0
        case "${words[1]} ${words[2]}" in
            replay\ start | mission\ export | mission\ archive | mission\ purge) list="replay missions" ;;
            alarm\ * | device\ * | domain\ * | mission\ * | replay\ * | template\ * | topic\ *) list="${words[1]} list" ;;
            dead-letters\ show) list="dead-letters list" ;;
            fields\ rename | fields\ end | fields\ delete) list="fields list" ;;
            *) return 0 ;;
        esac
    fi
    [[ $COMP_WORDBREAKS != *:* ]] || before=${cur%"${cur##*:}"}
    while IFS= read -r name; do
        [[ $name != "$cur"* ]] || COMPREPLY+=("${name#"$before"}")
    done < <(FURROW_COMPLETES=yes "${words[0]}" $list -o name 2>/dev/null)
}
complete -F _complete_furrow_names -o default furrow furrow.sh furrow.bash
