#include "cli/shell/scripts.hpp"

namespace quadrel::cli {
namespace {

// Bash breaks words at = and : and replaces only what stands behind the last of them; words are put
// together again here, up to the cursor.
constexpr const char* bash =
    R"script(# Completion of quadrel for bash, as `quadrel completion bash` prints it.
_quadrel() {
    local line=${COMP_LINE:0:COMP_POINT} word candidate endings ending
    local -a words=()
    for word in "${COMP_WORDS[@]:0:COMP_CWORD+1}"; do
        if ((${#words[@]})) && [[ $line != [[:blank:]]* ]]; then
            word=${word:0:${#line}}
            words[${#words[@]} - 1]+=$word
        else
            line=${line#"${line%%[![:blank:]]*}"}
            word=${word:0:${#line}}
            words+=("$word")
        fi
        line=${line#"$word"}
    done
    [[ $word == [=:]* ]] && word=
    local current=${words[${#words[@]} - 1]}
    local kept=${current%"$word"} program=${words[0]/#\~/$HOME}
    COMPREPLY=()
    while IFS=$'\t' read -r candidate endings; do
        if [[ $candidate == :files ]]; then
            compopt -o filenames
            while read -r candidate; do
                COMPREPLY+=("$candidate")
            done < <(compgen -d -- "$word"; for ending in ${endings:-''}; do
                compgen -f -X "!*$ending" -- "$word"; done | sort -u)
        else
            COMPREPLY+=("${candidate#"$kept"}")
        fi
    done < <("$program" completion words -- "${words[@]:1}" 2>/dev/null)
    [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[=.,] ]] && compopt -o nospace
}
complete -F _quadrel quadrel
)script";

constexpr const char* zsh = R"script(#compdef quadrel
# Completion of quadrel for zsh, as `quadrel completion zsh` prints it.
_quadrel() {
    local line word meaning tab=$'\t'
    local -a lines closed open endings
    local files=0 found=1
    lines=(${(f)"$("${(Q)words[1]/#\~/$HOME}" completion words -- \
        "${(@Q)words[2,CURRENT-1]}" "${(Q)PREFIX}" 2>/dev/null)"})
    for line in $lines; do
        word=${line%%$tab*} meaning=${line#*$tab}
        if [[ $word == :files ]]; then
            files=1 endings=(${=meaning})
        elif [[ $word == *[=.,] ]]; then
            open+=("${word//:/\\:}:$meaning")
        else
            closed+=("${word//:/\\:}:$meaning")
        fi
    done
    ((${#closed})) && _describe -t words word closed && found=0
    ((${#open})) && _describe -t words word open -S '' && found=0
    if ((files)); then
        compset -P '*='
        case ${#endings} in
            0) _files && found=0 ;;
            1) _files -g "*${endings[1]}" && found=0 ;;
            *) _files -g "*.(${(j:|:)endings#.})" && found=0 ;;
        esac
    fi
    return $found
}
if [[ ${funcstack[1]} == _quadrel ]]; then
    _quadrel "$@"
else
    compdef _quadrel quadrel
fi
)script";

constexpr const char* fish =
    R"script(# Completion of quadrel for fish, as `quadrel completion fish` prints it.
function __quadrel_words
    set -l words (commandline -opc)
    set -l token (commandline -ct)
    set -l program (string replace -r '^~' $HOME -- $words[1])
    set -e words[1]
    for line in (command $program completion words -- $words "$token" 2>/dev/null)
        set -l parts (string split -m 1 \t -- $line)
        if test "$parts[1]" != :files
            echo $line
            continue
        end
        set -l endings (string split -n ' ' -- $parts[2])
        set -l kept (string match -r '^.*=' -- $token)
        for file in (__fish_complete_path (string replace -r '^.*=' '' -- $token))
            set -l name (string split -m 1 \t -- $file)[1]
            set -l ending (string match -r '\.[^./]*$' -- $name)
            if string match -q '*/' -- $name; or test -z "$endings"; or contains -- "$ending" $endings
                echo "$kept$name"
            end
        end
    end
end
complete -c quadrel -f -a '(__quadrel_words)'
)script";

constexpr ShellScript scripts[] = {{"bash", bash}, {"zsh", zsh}, {"fish", fish}};

}  // namespace

std::span<const ShellScript> shell_scripts() { return scripts; }

}  // namespace quadrel::cli
