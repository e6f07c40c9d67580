# SPDX-License-Identifier: MIT
# Every kind of wrong command line: exit code 64 and one line with a hint; help and version.
. "$CHECK"

for verb in render merge diff compare scene bench info view; do
    expect 0 '' "$MANGATA" $verb --help
    grep -q "^usage: mangata $verb" stdout.txt || fail "$verb --help has no usage line"
    [[ ! -s stderr.txt ]] || fail "$verb --help writes to stderr"
    for option in --json --verbose --quiet --help; do
        grep -q -- "$option" stdout.txt || fail "$verb --help does not list $option"
    done
    expect 64 'unknown option --no-such-thing; see mangata' "$MANGATA" $verb --no-such-thing
done
expect 0 '' "$MANGATA" --help
grep -q '^  render ' stdout.txt || fail "--help does not list render"
expect 0 '' "$MANGATA" help diff
expect 0 '' "$MANGATA" --version
grep -Eq '^mangata [0-9]+\.[0-9]+\.[0-9]+$' stdout.txt || fail "--version: $(cat stdout.txt)"

expect 64 'no verb given' "$MANGATA"
expect 64 'unknown verb rendr; did you mean render\?' "$MANGATA" rendr
expect 64 'unknown verb zzz; see mangata --help' "$MANGATA" zzz
expect 64 'unknown option --fames; did you mean --frames\?' render "$simple" -o a.png --fames 3
expect 64 'unknown option -x' render "$simple" -x
expect 64 '--overwrite takes no value' render "$simple" -o a.png --overwrite=yes
expect 64 '-o=o.exr: allowed is -o OUT or --output=OUT' render "$simple" -o=o.exr
expect 64 '-n=5: allowed is -n N or --count=N' "$MANGATA" waves -n=5
for words in half,float zip,none,piz 'half --exr float' cryptomatte,cryptomatte:8; do
    # shellcheck disable=SC2086 # options are words
    expect 64 '^mangata: --exr: [a-z:0-9]+ and [a-z:0-9]+ contradict each other' render "$simple" -o a.exr --exr $words
done
works render "$simple" -o twice.exr --exr half,half,none --exr none "${small[@]}" "${null[@]}" --quiet
expect 64 '--gl-device 5: it is for --backend gl or auto alone' render "$simple" -o a.exr --gl-device 5
expect 64 '--gl-device 0: it is for --backend gl or auto alone' render "$simple" -o a.exr --gl-device 0 --backend cpu
expect 64 '--gl-device 5: it is for --backend gl or auto alone' "$MANGATA" bench "$simple" --gl-device 5
expect 64 '--gl-device 5: it is for --backend gl or auto alone' "$MANGATA" compare "$simple" -o a --gl-device 5
expect 64 '--frames needs a value' render "$simple" -o a.png --frames
expect 64 'no scene given' render -o a.png
expect 64 'no output given' render "$simple"
expect 64 'one scene at a time' render "$simple" "$simple" -o a.png

bad() { # OPTION VALUE PATTERN
    expect 64 "^mangata: --$1.*$3" render "$simple" -o a.png "--$1" "$2"
}
for value in 0x10 10x0 -1x5 1x 10 10x10x10 100000x100000 1e3x10 ' 1x1' 99999999999999999999x1; do
    bad size "$value" 'each from 1 to 32768'
done
for value in 1,2,3 1,2,3,0 a,b,c,d 1,2,3,4,5 -1,0,1,1; do
    bad crop "$value" 'X,Y,W,H'
done
bad size 32768x32768 'allowed are 268435456 pixels in all'
expect 64 '--crop 60,0,10,10: it lies outside the picture of 64 x 36 pixels' render "$simple" -o a.png --crop 60,0,10,10 "${small[@]}"
for value in ssaa0 ssaa1025 ssaa-1 ssaax Mangata '' reference8; do
    bad method "$value" 'none, ssaaN .N from 1 to 1024.'
done
for value in '' - 1- -1 5-3 1-9:0 1,1 3,2 1-5,5 1,,2 1.5 0-9x; do
    bad frames "$value" '(allowed|must|twice)'
done
for value in 100000000 0-100000000 0-1:100000000 4294967296 99999999999999999999; do
    bad frames "$value" 'frames and steps go up to 99999999'
done
bad seed -1 'whole number'
bad seed 18446744073709551616 'whole number'
bad threads 1025 'from 0'
bad isa sse9 'auto, scalar'
bad backend cuda 'cpu, gl'
bad layer colour 'color, coverage'
bad layer color,coverage 'or all; --layer may be repeated'
bad progress yes 'auto, json, text, openjd or none'
bad spatial 8 'for method ssaa or reference alone'
bad time-samples 8 'for method ssaa or reference alone'
bad samples-range 0,4 'takes one sample'
bad ndf-mean drop 'podee-pixel'
bad set nonsense 'nonsense'
for value in 0,0 512,1 0,513 1 0,-1 18446744073709551615,2; do
    expect 64 "samples-range $value: allowed is FIRST,COUNT (with COUNT at least 1|within the 512 samples)" render "$simple" -o a.png --method reference --samples-range "$value"
done
expect 64 'ssaaN' render "$simple" -o a.png --method ssaa4 --spatial 2
expect 64 '--ndf-mean maybe: allowed is one of add, drop' render "$simple" -o a.png --method podee-pixel --ndf-mean maybe

for option in 'kernels 9' 'integral kernels' 'elongation 9' 'path-segments 2' 'transition hard' 'transition-width 0.2'; do
    expect 64 'for method podee-uniform or podee-pixel' render "$simple" -o a.png --$option
done
podee() { expect 64 "$1" render "$simple" -o a.png --method podee-pixel "${@:2}"; }
podee '--kernels 2: allowed is one of exact, 1, 3, 5, 9, feline, riemann' --kernels 2
podee '--integral table: allowed is exact or kernels' --integral table
podee 'contradict' --kernels 9 --integral exact
podee '--elongation 0.9: allowed is a number, 0 or 1 to 1e6' --kernels 9 --elongation 0.9
podee '--elongation: it is for .* kernels 1, 3, 5, 9 or feline alone' --kernels riemann --elongation 5
podee '--path-segments 65: allowed is a whole number, 0 or 1 to 64' --path-segments 65
podee '--transition smooth: allowed is one of soft, hard' --transition smooth
podee '--transition-width 0.6: allowed is a number, 0 to 0.5' --transition-width 0.6
podee 'transition soft alone' --transition hard --transition-width 0.2

bad light-cells 20 'for method reference alone'
expect 64 '--light-cells 5000: allowed is a number, 0 to 4096' render "$simple" -o a.png --method reference --light-cells 5000
bad roughness-floor 0.1 'for method ggx-moments alone'
expect 64 '--roughness-floor 2: allowed is a number, 0 to 1' render "$simple" -o a.png --method ggx-moments --roughness-floor 2
for option in 'adaptive podee' 'samples 4' 'target-rmse 0.01' 'target-displayed 0.01' 'budget-ms 10' 'slots 1000' 'importance-center 0.1' 'importance-width 0.1' \
    'importance-threshold 0.1'; do
    for method in mangata none podee-uniform ssaa2; do
        expect 64 'it is for method adaptive' render "$simple" -o a.png --method $method --$option
    done
done
adaptive() { expect 64 "$1" render "$simple" -o a.png --method adaptive "${@:2}"; }
adaptive '--adaptive both: allowed is one of cells, podee' --adaptive both
for value in -1 0.5 1e9 4097 nan inf '' x; do
    adaptive "--samples $value: allowed is a number, 0 or 1 to 4096" --samples "$value"
    adaptive "--samples $value: allowed is a number, 0 or 1 to 4096" --adaptive podee --samples "$value"
done
for value in -0.1 2 nan; do
    adaptive "--target-rmse $value: allowed is a number, 0 or 1e-6 to 1" --target-rmse "$value"
    adaptive "--target-displayed $value: allowed is a number, 0 or 1e-5 to 1" --target-displayed "$value"
    adaptive "--importance-center $value: allowed is a number, 0 to 1" --adaptive podee --importance-center "$value"
    adaptive "--importance-width $value: allowed is a number, 0 or 1e-6 to 1" --adaptive podee --importance-width "$value"
    adaptive "--importance-threshold $value: allowed is a number, 0 to 1" --adaptive podee --importance-threshold "$value"
done
for value in 0.05 -5 1e9; do
    adaptive "--budget-ms $value: allowed is a number, 0 or 0.1 to 1e7 ms" --budget-ms "$value"
done
for value in -1 4294967297 1.5 18446744073709551617; do
    adaptive "--slots $value: allowed is a whole number, 0 or 1 to 4294967296" --adaptive podee --slots "$value"
done
for both in '--samples 8 --target-rmse 0.01' '--samples 8 --budget-ms 10' '--target-rmse 0.01 --budget-ms 10' \
    '--target-rmse 0.01 --target-displayed 0.01' '--samples 8 --target-displayed 0.01' '--target-displayed 0.01 --budget-ms 10' \
    '--adaptive podee --samples 8 --slots 1000'; do
    # shellcheck disable=SC2086 # options are words
    adaptive 'each says how much to sample' $both
done
adaptive '^mangata: --samples and --target-rmse exclude each other' --samples 4 --target-rmse 0.1
adaptive '--slots: it is for method adaptive and adaptive podee alone' --slots 1000
adaptive '--slots: it is for method adaptive and adaptive podee alone' --adaptive cells --slots 1000
for option in 'target-rmse 0.01' 'target-displayed 0.01' 'budget-ms 10'; do
    adaptive "--${option% *}: it is for method adaptive and adaptive cells alone" --adaptive podee --$option
done
for option in 'importance-center 0.1' 'importance-width 0.1' 'importance-threshold 0.1'; do
    adaptive "--${option% *}: it is for method adaptive and adaptive podee alone" --$option
done

expect 64 'unknown kind of file; allowed are .png .exr .pfm .mp4 .mov .y4m' render "$simple" -o a.jpg
expect 64 'unknown kind of file' render "$simple" -o png
expect 64 'names no file' render "$simple" -o folder/
expect 64 '2 frames do not fit into one picture' render "$simple" -o a.png --frames 3-4
expect 64 'leave the frame number out' render "$simple" -o a%04d.mp4
for name in a%s.png a%n.png a%04x.png a%4d.png a%.png a%99d.png 'a%0100d.png' 'a##########.png'; do
    expect 64 'the frame number is written' render "$simple" -o "$name" "${null[@]}"
done
expect 64 'only one frame number' render "$simple" -o 'a%04d_%d.png'
for folder in %04d a####b; do
    expect 73 "folder $folder: No such file or directory; a frame number is allowed in the file's name alone" render "$simple" -o "$folder/e.png"
done
expect 64 'only one frame number' render "$simple" -o 'a##_##.png'
expect 64 'depth does not fit into 8 bits; write .exr or .pfm' render "$simple" -o a.png --layer depth
for name in a.png a.y4m; do
    expect 64 "$name: refraction does not fit into 8 bits; write .exr or .pfm" render "$simple" -o $name --layer refraction
done
expect 64 'only .exr holds several layers' render "$simple" -o a.pfm --layer mask --layer depth
expect 64 'only .exr holds several layers' render "$simple" -o a.png --layer all

expect 64 'two pictures are needed' "$MANGATA" diff a.png
expect 64 'one more' "$MANGATA" diff a.png b.png c.png
expect 64 'number both names or neither' "$MANGATA" diff a##.png b.png --frames 0-1
expect 64 'need --frames' "$MANGATA" diff a##.png b##.png
expect 64 'needs numbered names' "$MANGATA" diff a.png b.png --frames 0-1
expect 64 'at least two frames' "$MANGATA" diff a.png b.png --flicker
expect 64 'a number from 0' "$MANGATA" diff a.png b.png --max-rmse nan
expect 64 'texture needs --second-reference B2' "$MANGATA" diff a.png b.png --metrics texture
expect 64 'second-reference c##.png: number both names or neither' "$MANGATA" diff a.png b.png --second-reference c##.png
expect 64 'c%s.png: the frame number is written' "$MANGATA" diff a.png b.png --second-reference c%s.png
expect 64 'b.png is B itself' "$MANGATA" diff a.png b.png --second-reference b.png
expect 64 'a.png is A itself' "$MANGATA" diff a.png b.png --second-reference a.png
expect 64 'b.png and --second-reference c.pfm hold values of unlike encoding' "$MANGATA" diff a.png b.png --second-reference c.pfm
expect 64 'goes with no --second-reference' "$MANGATA" diff a##.png b##.png --frames 0-1 --flicker --second-reference c##.png
expect 64 'goes with no --metrics' "$MANGATA" diff a##.png b##.png --frames 0-1 --flicker --metrics specks
for list in '' , texture, ,specks textur specks,flop "$(printf 'x%.0s' {1..99})"; do
    expect 64 'flicker-sizes, texture, specks, separated by commas' "$MANGATA" diff a.png b.png --metrics "$list"
done
expect 64 'takes check FILE or schema' "$MANGATA" scene
expect 64 'takes check FILE or schema' "$MANGATA" scene chekc "$simple"
expect 64 'no scene given' "$MANGATA" scene check
expect 64 'unknown method fast; allowed are none, ssaaN' "$MANGATA" bench "$simple" --methods none,fast
expect 64 'none\+mirror: --refraction mirror: allowed is one of two-phase, hybrid' "$MANGATA" bench "$simple" --methods none+mirror
expect 64 'it is for refraction two-phase' "$MANGATA" bench "$simple" --methods none+off:tess-error=1
expect 64 'unknown option seed; allowed are the options of quality in mangata render --help, but for seed' "$MANGATA" bench "$simple" --methods none:seed=3
expect 64 'unknown option refraction;' "$MANGATA" bench "$simple" --methods none:refraction=off
expect 64 'info takes no' "$MANGATA" info now
cp "$MANGATA" alone # the viewer is looked for beside the command first
expect 69 'the viewer is not installed' env PATH=/nonexistent ./alone view "$simple"
expect 69 'OpenGL|EGL' render "$simple" -o a.png --backend gl --gl-device 63
bad gl-device -1 '0 to 1023'
if [[ $(uname -m) == x86_64 ]]; then
    expect 69 '^mangata: --isa neon: this processor or build does not have it; available are auto, scalar, sse2' render "$simple" -o a.png --isa neon
fi
absent a.png
finish
