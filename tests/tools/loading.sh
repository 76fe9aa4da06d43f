#!/bin/sh
# Models from strangers: whatever a file does to the loader, zsim says one sentence, ends with status 1 within seconds
# and leaves no file. What a model names outside its folder is not read.
# Usage: tests/tools/loading.sh BUILD     from the repository's top; BUILD/test/zsim, and BUILD/zsim, which has limits
#        of memory: AddressSanitizer leaves none
set -u
build=$(cd "$1" && pwd) || exit 1
set -- "$build/test/zsim" "$build/test/loading"
. tests/tools/zsim.sh
sanitized=$zsim plain=$build/zsim
gcc -O1 -Wall -Wextra -Werror "$top/tests/tools/mutate.c" -o mutate || exit 1
gcc -O1 -Wall -Wextra -Werror -shared -fPIC "$top/tests/tools/loader_fault.c" -Wl,--no-as-needed -lassimp -ldl \
    -o fault.so || exit 1

# ---- Models: a triangle, 1 to 36 the bytes of its positions -------------------------------------
one='\000\000\200\077' nul='\000\000\000\000'
tri() { printf "$nul$nul$nul$one$nul$nul$nul$one$nul"; }
inline='data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA'
gltf() { # NODES BUFFER [MATERIALS AND TEXTURES]
    printf '{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[%s],' "$1"
    printf '"meshes":[{"primitives":[{"attributes":{"POSITION":0%s}%s}]}],' "${3:+,\"TEXCOORD_0\":1}" \
        "${3:+,\"material\":0}"
    printf '"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},'
    printf '{"bufferView":0,"componentType":5126,"count":3,"type":"VEC2"}],'
    printf '"bufferViews":[{"buffer":0,"byteLength":36}],%s"buffers":[{"uri":"%s","byteLength":36}]}' "${3:-}" "$2"
}
textured() { # NAME PICTURE
    gltf '{"mesh":0}' "$inline" "\"images\":[{\"uri\":\"$2\"}],\"textures\":[{\"source\":0}],\"materials\":[{
        \"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}]," >"$1"
}
gltf '{"mesh":0}' "$inline" >tri.gltf
obj tri 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'f 1 2 3'
gcc -O1 -Wall -Wextra -Werror -x c -o dot - -lpng <<'END' || exit 1
#include <png.h>
int main(void)
{
    png_image image = { .version = PNG_IMAGE_VERSION, .width = 2, .height = 2, .format = PNG_FORMAT_RGB };
    return !png_image_write_to_file(&image, "dot.png", 0, "\0\0\377\0\377\0\377\0\0\377\377\377", 0, NULL);
}
END
./dot || exit 1

# One sentence about a model, nothing left; within a minute of this machine, however busy it is
refused_soon() { # MODEL WHAT-THE-LINE-HOLDS OPTION...
    model=$1 what=$2
    shift 2
    last=" zsim render $model $*"
    timeout 60 "$zsim" render "$model" --out refused/new.png "$@" >stdout 2>stderr </dev/null
    status=$?
    one_line 1 "$model: "
    case $the_line in *"$what"*) ;; *) wrong "'$what' is not in: $(said)" ;; esac
    untouched
}
drawn() { # MODEL OPTION...
    z render "$@" --out out/x.png
    [ $status -eq 0 ] && [ ! -s stderr ] || wrong "status $status: $(said)"
}

# ---- A polygon of very many corners, half of which turn inwards: cut within the loader's seconds ------------
begin comb_of_8000_corners
awk 'BEGIN {
    for (i = 0; i < 4000; i++) print "v", i, 1000 * (i % 2), 0
    for (i = 3999; i >= 0; i--) print "v", i, 1000 * (i % 2) + 400, 0
    printf "f"; for (i = 1; i <= 8000; i++) printf " %d", i; print "" }' >comb.obj
drawn comb.obj --cull none

# ---- Files that are none ------------------------------------------------------------------------
mkfifo fifo.obj fifo.gltf fifo.bin fifo.png
: >empty.gltf
: >empty.ply
mkdir folder.obj folder.gltf
for zsim in "$sanitized" "$plain"; do
    begin "no_file_$(basename "$(dirname "$zsim")")"
    refused_soon empty.gltf 'is empty'
    refused_soon empty.ply 'is empty'
    refused_soon folder.obj 'is a directory'
    refused_soon folder.gltf 'is a directory'
    refused_soon fifo.obj 'is not a regular file'
    refused_soon fifo.gltf 'is not a regular file'
    refused_soon /dev/zero 'is not a regular file'
    refused_soon none.gltf 'cannot be read'
done
zsim=$sanitized

begin buffer_that_is_missing
gltf '{"mesh":0}' none.bin >missing.gltf
refused_soon missing.gltf 'it names none.bin, which is not there; put that file beside it'

begin skin_without_matrices # glTF lets them out where they would be 1
gltf '{"mesh":0,"skin":0}' "$inline" '"skins":[{"joints":[0]}],' |
    sed 's/"meshes":\[{/&"name":"arm",/; s/,"TEXCOORD_0":1},"material":0/,"JOINTS_0":2,"WEIGHTS_0":3}/
        s/\],"bufferViews/,{"bufferView":0,"componentType":5121,"count":3,"type":"VEC4"}&/
        s/\],"bufferViews/,{"bufferView":0,"componentType":5126,"count":2,"type":"VEC4"}&/' >skin.gltf
z render skin.gltf --out out/skin.png
is status $status 0
is losses "$(cat stderr)" 'zsim: skin.gltf: not carried over: skin (1, of mesh "arm")'
z render tri.gltf --out out/x.png
cmp -s out/x.png out/skin.png || wrong 'it is drawn otherwise than without a skin'

begin buffers_and_textures_that_are_no_files
gltf '{"mesh":0}' fifo.bin >buffer_fifo.gltf
refused_soon buffer_fifo.gltf 'names fifo.bin, which is not a regular file'
gltf '{"mesh":0}' /dev/zero >buffer_zero.gltf
refused_soon buffer_zero.gltf 'names /dev/zero, which is outside'
refused_soon buffer_zero.gltf 'names /dev/zero, which is not a regular file' --allow-outside
textured picture_fifo.gltf fifo.png
refused_soon picture_fifo.gltf 'names fifo.png, which is not a regular file' --shade unlit
textured picture_zero.gltf /dev/zero
refused_soon picture_zero.gltf '/dev/zero, which is outside' --shade unlit
refused_soon picture_zero.gltf '/dev/zero, which is not a regular file' --shade unlit --allow-outside
z render picture_fifo.gltf --out refused/new.png --shade unlit --texture fifo.png
one_line 1 'fifo.png: is not a regular file'

# ---- Outside ------------------------------------------------------------------------------------
mkdir -p models/own elsewhere
tri >elsewhere/far.bin
tri >models/own/near.bin
cp dot.png elsewhere/far.png
cp dot.png models/own/near.png
ln -s ../elsewhere/far.bin models/link.bin
ln -s own/near.bin models/inner.bin
ln -s ../elsewhere models/way
ln -s models/tri.gltf link.gltf
begin own_files_are_read
for buffer in own/near.bin ./own/near.bin own/../own/near.bin inner.bin; do
    gltf '{"mesh":0}' $buffer >models/own.gltf
    drawn models/own.gltf
    (cd models && z render own.gltf --out ../out/x.png && exit $status) || wrong "not from its own folder: $buffer"
done
textured models/pic.gltf own/near.png
drawn models/pic.gltf --shade unlit
gltf '{"mesh":0}' own/near.bin >models/tri.gltf
begin outside_is_refused_by_name
for buffer in ../elsewhere/far.bin own/../../elsewhere/far.bin link.bin way/far.bin; do
    gltf '{"mesh":0}' $buffer >models/out.gltf
    refused_soon models/out.gltf "$buffer, which is outside the model's folder"
    drawn models/out.gltf --allow-outside
    z convert models/out.gltf --name m --out out/converted
    one_line 1 "$buffer, which is outside the model's folder"
    z budget models/out.gltf
    one_line 1 "$buffer, which is outside the model's folder"
done
gltf '{"mesh":0}' "$work/elsewhere/far.bin" >models/out.gltf
refused_soon models/out.gltf "$work/elsewhere/far.bin" # assimp looks for it in the model's folder alone
refused_soon link.gltf 'own/near.bin' # its folder is the one that the link is in
for picture in ../elsewhere/far.png "$work/elsewhere/far.png" way/far.png; do
    textured models/pic.gltf $picture
    refused_soon models/pic.gltf "$picture, which is outside the model's folder" --shade unlit
    drawn models/pic.gltf --shade unlit --allow-outside
done
textured models/pic.gltf /somewhere/else/beside.png
cp dot.png models/beside.png
drawn models/pic.gltf --shade unlit # a bare name beside the model counts
printf 'newmtl a\nKd 1 0 0\n' >elsewhere/a.mtl
obj models/m 'mtllib ../elsewhere/a.mtl' 'usemtl a' 'v 0 0 0' 'v 1 0 0' 'v 0 1 0' 'f 1 2 3'
refused_soon models/m.obj "../elsewhere/a.mtl, which is outside the model's folder"
drawn models/m.obj --allow-outside
begin nothing_outside_is_looked_at
gltf '{"mesh":0}' ../elsewhere/there_is_none.bin >models/out.gltf
refused_soon models/out.gltf 'there_is_none.bin, which is outside'

# ---- Limits -------------------------------------------------------------------------------------
zsim=$plain
begin nested_nodes
nodes=$(awk 'BEGIN { for (i = 1; i < 100000; i++) printf "{\"children\":[%d]},", i; print "{\"mesh\":0}" }')
gltf "$nodes" "$inline" >deep.gltf
refused_soon deep.gltf 'nested too deep'
begin nested_brackets
awk 'BEGIN { printf "{\"asset\":{\"version\":\"2.0\"},\"x\":"; for (i = 0; i < 200000; i++) printf "["
    for (i = 0; i < 200000; i++) printf "]"; print "}" }' >brackets.gltf
refused_soon brackets.gltf 'nested too deep'
begin nodes_named_twice
nodes=$(awk 'BEGIN { for (i = 1; i < 40; i++) printf "{\"children\":[%d,%d]},", i, i; print "{\"mesh\":0}" }')
gltf "$nodes" "$inline" >twice.gltf
refused_soon twice.gltf 'MB of memory'
refused_soon twice.gltf 'more than 200 MB of memory' --load-memory 200
begin memory_is_as_much_as_is_given
awk 'BEGIN { for (i = 0; i < 300000; i++) print "v", i, i % 7, i % 11
    for (i = 1; i < 299998; i++) print "f", i, i + 1, i + 2 }' >many.obj
refused_soon many.obj 'more than 100 MB of memory' --load-memory 100
drawn many.obj --load-memory 2000
begin model_that_aborts_the_loader # an archive whose model is empty
base64 -d >empty.3mf <<'END'
UEsDBBQAAAAAAASQd11Y4JSfowAAAKMAAAALAAAAX3JlbHMvLnJlbHM8P3htbCB2ZXJzaW9uPSIxLjAiPz48UmVsYXRpb25zaGlw
cz48UmVsYXRpb25zaGlwIElkPSJhIiBUYXJnZXQ9Ii8zRC9tLm1vZGVsIiBUeXBlPSJodHRwOi8vc2NoZW1hcy5taWNyb3NvZnQu
Y29tLzNkbWFudWZhY3R1cmluZy8yMDEzLzAxLzNkbW9kZWwiLz48L1JlbGF0aW9uc2hpcHM+UEsDBBQAAAAAAASQd10AAAAAAAAA
AAAAAAAKAAAAM0QvbS5tb2RlbFBLAQIUAxQAAAAAAASQd11Y4JSfowAAAKMAAAALAAAAAAAAAAAAAACAAQAAAABfcmVscy8ucmVs
c1BLAQIUAxQAAAAAAASQd10AAAAAAAAAAAAAAAAKAAAAAAAAAAAAAACAAcwAAAAzRC9tLm1vZGVsUEsFBgAAAAACAAIAcQAAAPQA
AAAAAA==
END
refused_soon empty.3mf 'cannot be loaded'

# ---- A loader that goes wrong -------------------------------------------------------------------
fault() { # HOW WHAT-THE-LINE-HOLDS OPTION...
    begin "loader_$1"
    how=$1 what=$2
    shift 2
    LOADER_FAULT=$how LD_PRELOAD=$work/fault.so
    export LOADER_FAULT LD_PRELOAD
    timeout 60 "$zsim" render tri.obj --out refused/new.png "$@" >stdout 2>stderr </dev/null
    status=$?
    unset LD_PRELOAD
    one_line 1 "tri.obj: "
    grep -qF -- "$what" stderr || wrong "'$what' is not in: $(said)"
    untouched
}
fault missing 'install libassimp-dev'
fault abort 'signal 6'
fault segv 'signal 11'
fault kill 'signal 9'
fault stack 'nested too deep'
fault status 'status 42'
fault nothing 'left no sound model'
fault junk 'left no sound model'
fault flood 'more than 64 MB' --load-memory 64
fault spin 'more than 1 s' --load-seconds 1
fault sleep 'more than 1 s' --load-seconds 1
begin loader_ends_with_its_parent
LOADER_FAULT=sleep LD_PRELOAD=$work/fault.so "$zsim" render tri.obj --out refused/new.png >stdout 2>stderr &
pid=$!
for i in 1 2 3 4 5 6 7 8 9 10; do
    child=$(tr -d " " </proc/$pid/task/$pid/children 2>/dev/null)
    [ -z "$child" ] || break
    sleep 0.2
done
[ -n "$child" ] || wrong "there is no process for the loader"
kill -9 $pid
wait $pid 2>/dev/null
for i in 1 2 3 4 5 6 7 8 9 10; do
    [ -e "/proc/${child:-0}" ] || break
    sleep 0.2
done
if [ -e "/proc/${child:-0}" ]; then
    wrong "the loader lives on"
    kill -9 "$child"
fi
untouched

# ---- Mutations ----------------------------------------------------------------------------------
zsim=$sanitized
mutations() { # FILE COUNT: each is drawn, or refused with a sentence
    copy=mutant.${1##*.} ended=0
    ./mutate "$1" 1 "$2" "$copy" "$zsim" render "$copy" --out out/x.png >mutants || wrong "mutate $1"
    : >stderr
    # what is not carried over of a picture that is drawn is named, and nothing else
    lines=0 ours=0 named=0
    while IFS= read -r line; do
        after=${line#zsim: mutant}
        case $line--${after#*:} in
        'end '*)
            seed=${line#end } status=${line##* }
            seed=${seed% *} ended=$((ended + 1))
            last=" mutate $1 $seed >$copy; zsim render $copy"
            [ "$status" = 0 ] || lines=$((lines + named)) ours=$((ours + named))
            [ "$status" -le 1 ] && [ $lines -eq "$status" ] && [ $ours -eq "$status" ] ||
                wrong "mutation $seed of $1: status $status: $(said)"
            lines=0 ours=0 named=0
            : >stderr
            continue ;;
        'zsim: mutant'*'-- not carried over: '* | 'zsim: mutant'*'-- material file '*) named=$((named + 1)) ;;
        'zsim: '*) lines=$((lines + 1)) ours=$((ours + 1)) ;;
        *) lines=$((lines + 1)) ;;
        esac
        printf '%s\n' "$line" >>stderr
    done <mutants
    is "mutations of $1" "$ended" "$2"
}
{
    printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n'
    printf 'element face 2\nproperty list uchar int vertex_indices\nend_header\n'
    printf '0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n'
} >mutate.ply
printf 'OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n' >mutate.off
printf 'mtllib m.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0 1 0 0\nvt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3//1\nf -3 -2 -1\n' \
    >mutate.obj
begin mutations_by_the_checked_program
mutations mutate.ply 12
mutations mutate.off 12
mutations mutate.obj 12
mutations tri.gltf 12
zsim=$plain
begin mutations
mutations mutate.ply 60
mutations mutate.off 60
mutations mutate.obj 60
mutations tri.gltf 60
mutations empty.3mf 20

# ---- Temporary files ----------------------------------------------------------------------------
begin killed_and_run_again
mkfifo wait.pgm # opening it waits for a reader, when the picture is already on the disk
"$zsim" render tri.obj --out refused/new.png --depth-out wait.pgm >stdout 2>stderr &
pid=$!
for i in 1 2 3 4 5 6 7 8 9 10; do
    [ "$(ls -A refused | wc -l)" -lt 2 ] || break
    sleep 0.2
done
is "files beside the old one" "$(ls -A refused | grep -c '^\.zsim-......$')" 1
drawn tri.obj
z render tri.obj --out refused/second.png
is "the one that is being written" "$(ls -A refused | grep -c '^\.zsim-......$')" 1
kill -9 $pid
wait $pid 2>/dev/null
is "left over" "$(ls -A refused | grep -c '^\.zsim-......$')" 1
echo mine >refused/.zsim-of-mine
z render tri.obj --out refused/third.png
is "files in the folder" "$(ls -A refused | tr '\n' ' ')" ".zsim-of-mine old.png second.png third.png "
finish
[ $n_failed -eq 0 ]
