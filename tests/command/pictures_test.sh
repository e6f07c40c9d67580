# SPDX-License-Identifier: MIT
# Pictures and films as other programs read them: oiiotool sees an EXR's place, attributes and channels, ffprobe a film's codec and colours.
. "$CHECK"
sunset=$SOURCE/scenes/sunset.json
size=(--size 128x72 --quiet)

if command -v oiiotool >/dev/null; then
    says() { # FILE PATTERN…: what oiiotool says of it
        local file=$1 pattern info
        shift
        info=$(oiiotool --info -v "$file")
        for pattern; do grep -Eq -- "$pattern" <<<"$info" || fail "$file: no '$pattern' in: $info"; done
    }
    works render "$sunset" -o whole.exr --layer all "${size[@]}"
    says whole.exr '128 x +72' 'chromaticities: 0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329' 'whiteLuminance: 1000' 'framesPerSecond: 30/1' \
        'ExposureTime: 0.0333333' 'worldToCamera' 'compression: "zip"' 'channel, float' 'channel list: R, G, B, '
    # Colours of other primaries are those of sRGB when they are read.
    works render "$sunset" -o linear.exr --frames 0 "${size[@]}" --layer color --layer refraction
    works render "$sunset" -o ap1.exr --frames 0 "${size[@]}" --layer color --layer refraction --exr acescg
    expect 0 '' "$MANGATA" diff ap1.exr linear.exr --json
    "$JSON_GET" relative_rmse <stdout.txt | awk '{ exit !($1 < 1e-6) }' || fail "ACEScg: $(cat stdout.txt)"
    # Metrics take grey and colours.
    oiiotool linear.exr --ch R,G,B,A=0.5 -o four.png
    expect 65 'four.png: it has 4 channels; --metrics and --error-map take pictures of 1 or 3' "$MANGATA" diff four.png four.png --metrics flip
    # Crops at unlike places are told.
    works render "$sunset" -o crop1.exr --frames 0 "${size[@]}" --crop 10,10,40,20
    works render "$sunset" -o crop2.exr --frames 0 "${size[@]}" --crop 20,12,40,20
    expect 0 'warning: crop1.exr lies at 10,10 of its whole picture, crop2.exr at 20,12; they are compared' "$MANGATA" diff crop1.exr crop2.exr
    expect 0 '' "$MANGATA" diff crop1.exr crop1.exr
    [[ ! -s stderr.txt ]] || fail "a warning of places: $(cat stderr.txt)"
    # Channels of other programs, in whatever case and as words.
    for names in r,g,b Red,Green,Blue sun.r,sun.g,sun.b; do
        oiiotool whole.exr --ch R,G,B --chnames $names -o other.exr || fail "oiiotool cannot name channels"
        expect 0 '' "$MANGATA" diff other.exr whole.exr --max-rmse 0
    done
    oiiotool --info -v whole.exr | grep -q 'pixel data origin: x=[^0]' && fail "a whole picture has no place but the corner"

    # Tiles lie at their place, and four of them are the whole, byte for byte.
    tiles=()
    for place in 0,0,50,30 50,0,78,30 0,30,50,42 50,30,78,42; do
        works render "$sunset" -o "t_$place.exr" --layer all --crop "$place" "${size[@]}"
        IFS=, read -r x y _ <<<"$place"
        says "t_$place.exr" 'full/display size: 128 x 72'
        [[ $place == 0,0* ]] || says "t_$place.exr" "pixel data origin: x=$x, y=$y"
        tiles+=("t_$place.exr" --croptofull)
        ((${#tiles[@]} == 2)) || tiles+=(--add)
    done
    oiiotool "${tiles[@]}" -d float -o joined.exr || fail "oiiotool cannot join the tiles"
    for layer in color coverage mask normal samples refraction; do
        expect 0 '' "$MANGATA" diff joined.exr whole.exr --layer $layer --max-rmse 0
        [[ $(oiiotool --info joined.exr) == *128*72* ]] || fail "joined.exr has another size"
    done
    oiiotool whole.exr --ch R,G,B,coverage.Y,mask.Y,depth.Z -d float -o a.tif && oiiotool joined.exr --ch R,G,B,coverage.Y,mask.Y,depth.Z -d float -o b.tif
    [[ $(oiiotool --hash --info a.tif | grep -o 'SHA-1.*') == "$(oiiotool --hash --info b.tif | grep -o 'SHA-1.*')" ]] || fail "the joined tiles are not the whole, byte for byte"

    # Halves, packing, alpha and planar depth.
    works render "$sunset" -o half.exr --layer color --layer depth --layer mask --exr half,piz,alpha,z "${size[@]}"
    says half.exr 'R \(half\), G \(half\), B \(half\), A \(half\)' ' Z \(float\)' 'depth.Z \(float\)' 'compression: "piz"'
    works render "$sunset" -o none.exr --exr none,z,alpha --crop 3,5,20,10 "${size[@]}"
    says none.exr 'compression: "none"' 'channel list: R, G, B, A, Z' 'channel, float' 'pixel data origin: x=3, y=5'
    works render "$sunset" -o z.exr --layer depth --layer mask --exr alpha,z "${size[@]}"
    expect 0 '' "$MANGATA" diff half.exr whole.exr --layer depth --max-rmse 0
    expect 0 '' "$MANGATA" diff half.exr whole.exr --layer color --display 0 --max-rmse 0.001
    oiiotool z.exr --ch A -o alpha.exr && oiiotool z.exr --ch mask.Y --chnames A -o mask.exr
    expect 0 '' "$MANGATA" diff alpha.exr mask.exr --layer A --max-rmse 0
    # At the middle of the picture the ray is the view; at the corner the cosine is 1 / √(1 + (w² + h²)), with half the picture's size at distance 1.
    oiiotool z.exr --ch Z,depth.Z --cut 1x1+0+71 --printstats >corner
    python3 - "$(oiiotool --info -v z.exr | sed -n 's/.*screenWindowWidth: //p')" <<'END' || fail "planar depth: $(cat corner)"
import re, sys
z, along = map(float, re.search(r"Avg: (\S+) (\S+)", open("corner").read()).groups())
w = float(sys.argv[1]) / 2
x, y = w * (1 / 128 - 1), w * 72 / 128 * (143 / 72 - 1)
sys.exit(abs(z / along * (1 + x * x + y * y) ** 0.5 - 1) > 1e-5)
END
    # The matrices: the camera's target is in the middle, where the view goes.
    works render "$sunset" -o camera.exr --set camera.position='[3, 5, 7]' --set camera.target='[10, 2, -40]' --set camera.up='[0.1, 1, 0]' "${size[@]}"
    oiiotool --info -v camera.exr | sed -n 's/ *worldTo[A-Za-z]*: //p' >matrices
    python3 - matrices <<'END' || fail "worldToCamera, worldToNDC: $(cat matrices)"
import math, sys
camera, ndc = ([float(v) for v in line.split(",")] for line in open(sys.argv[1]))
def times(p, m):
    q = [sum((list(p) + [1])[i] * m[4 * i + k] for i in range(4)) for k in range(4)]
    return [v / q[3] for v in q[:3]]
distance = math.dist((3, 5, 7), (10, 2, -40))
at = times((10, 2, -40), camera)
middle = times((10, 2, -40), ndc)
above = times((10, 3, -40), ndc)
right = times((11, 2, -40), ndc)
assert max(abs(at[0]), abs(at[1]), abs(at[2] - distance)) < 1e-4, at
assert max(abs(middle[0] - .5), abs(middle[1] - .5)) < 1e-5, middle
assert above[1] < .5 and right[0] > .5, (above, right)
END
    # ACEScg: grey stays grey, and the primaries are said.
    works render "$sunset" -o aces.exr --exr acescg "${size[@]}"
    says aces.exr 'chromaticities: 0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767'
    oiiotool whole.exr --ch R,G,B --ccmatrix 0.6130974024,0.0701937225,0.0206155929,0.3395231462,0.9163538791,0.1095697729,0.0473794514,0.0134523985,0.8698146342 -d float -o matrix.exr || fail "oiiotool --ccmatrix"
    oiiotool aces.exr --eraseattrib chromaticities -o stored.exr # the values as they are stored
    expect 0 '' "$MANGATA" diff stored.exr matrix.exr --display -4 --max-rmse 1e-6
    # A part for each layer: the same values as in one part, and readable by layer, by channel and by part.
    works render "$sunset" -o parts.exr --layer all --exr parts,alpha,z "${size[@]}"
    oiiotool --info -a -v parts.exr >parts.txt
    grep -q ' 11 subimages: ' parts.txt && grep -q 'channel list: R, G, B, A, Z' parts.txt && grep -q 'subimagename: "normal"' parts.txt || fail "parts: $(cat parts.txt)"
    (($(grep -c 'whiteLuminance: 1000' parts.txt) == 11 && $(grep -c mangata.render_hash parts.txt) == 1)) || fail "attributes of parts: $(cat parts.txt)"
    for layer in color coverage depth normal normal.Y samples foam; do
        expect 0 '' "$MANGATA" diff parts.exr whole.exr --layer $layer --max-rmse 0
    done
    expect 0 'nothing to render' render "$sunset" -o parts.exr --layer all --exr parts,alpha,z --size 128x72 --skip-existing
    oiiotool whole.exr --ch depth.Z --chnames Z --attrib oiio:subimagename depth whole.exr --ch R,G,B --attrib oiio:subimagename rgb --siappend -o foreign.exr
    expect 0 '' "$MANGATA" diff foreign.exr whole.exr --layer color --max-rmse 0
    oiiotool foreign.exr --subimage depth --chnames depth.Z -o depth.exr
    expect 0 '' "$MANGATA" diff depth.exr whole.exr --layer depth --max-rmse 0
    expect 0 '' "$MANGATA" diff foreign.exr depth.exr --layer depth --max-rmse 0
    works render "$SOURCE/scenes/pool.yaml" -o matte.exr --layer color --layer depth --exr parts,half,cryptomatte:2 "${size[@]}"
    oiiotool --info -a -v matte.exr >parts.txt
    grep -q 'crypto_object02.A' parts.txt && grep -q 'subimagename: "crypto_object"' parts.txt && grep -q '[[]f,f,f,f,f,f,f,f,f,f,f,f[]]' parts.txt || fail "mattes in parts: $(cat parts.txt)"
    (($(grep -c 'cryptomatte/f834d0a/manifest.*"balls/2":"' parts.txt) == 1)) || fail "manifest: $(cat parts.txt)"
else
    echo "NOTICE: no oiiotool here; EXR was not read by another program"
fi

# Cryptomatte, read by a decoder of its own.
python=/usr/bin/python3
[[ -x $python ]] || python=python3
mattes() { timeout 60 "$python" "$SOURCE/tests/command/cryptomatte.py" "$@" || fail "cryptomatte.py $*"; }
near() { awk -v a="$1" -v b="$2" -v by="$3" 'BEGIN { exit !(a - b < by && b - a < by) }' || fail "$4: $1, not $2"; }
matte() { works render "$1" -o "$2" --exr none,cryptomatte:${side:-8} --layer depth --method none --quiet "${@:3}"; }
"$MANGATA" render "$simple" -o embree.exr --exr cryptomatte:1 "${small[@]}" --quiet 2>/dev/null
if (($? != 69)) && command -v "$python" >/dev/null; then
    # A ball half before the sky, half before the water: its outline on the screen is a disk of known size.
    cat >ball.yaml <<'END'
mangata: 1
image: {width: 60, height: 40}
camera: {position: [0, 50, 0], target: [0, 50, -10], fov_y_deg: 40}
objects: [{shape: sphere, size: [4, 4, 4], position: [0, 50, -12], triangles: 20000}]
END
    matte ball.yaml ball.exr
    disk=$(awk 'BEGIN { t = 0.36397; r = 2 / sqrt(144 - 4); print atan2(0, -1) * r * r / (4 * t * t * 1.5) }')
    near "$(mattes ball.exr sphere)" "$disk" 0.0005 "the ball's share of the picture"
    near "$(mattes ball.exr sky)" "$(mattes ball.exr water)" 0.002 "sky over a high horizon, and water below it"
    [[ $(mattes ball.exr sphere 30 20) == 1.0 ]] || fail "the middle of the ball: $(mattes ball.exr sphere 30 20)"
    # A floor under flat water, seen from straight above: the surface mirrors ((n - 1) / (n + 1))².
    cat >floor.yaml <<'END'
mangata: 1
image: {width: 41, height: 41}
camera: {position: [0, 3, 0], target: [0, 0, 0], up: [0, 0, -1], fov_y_deg: 20}
objects: [{name: "the floor \"é\"", shape: plane, size: [9, 9, 9], position: [0, -1, 0]}, {name: tile, shape: box, size: [0.3, 0.3, 0.3], position: [0, 0.4, 0.35]}]
water: {ior: 1.333}
END
    matte floor.yaml floor.exr
    near "$(mattes floor.exr 'the floor "é"' 20 20)" "$(awk 'BEGIN { r = 0.333 / 2.333; print 1 - r * r }')" 1e-4 "what comes through the surface"
    near "$(mattes floor.exr water 20 20)" "$(awk 'BEGIN { r = 0.333 / 2.333; print r * r }')" 1e-4 "what it mirrors"
    # Every name, place by place; a crop and any number of threads give the same bytes.
    side=2 matte "$SOURCE/scenes/pool.yaml" pool.exr --size 96x54
    side=2 matte "$SOURCE/scenes/pool.yaml" crop.exr --size 96x54 --crop 21,9,40,30 --threads 3
    mattes crop.exr --crop-of pool.exr 21 9
    expect 73 'was not rendered' render floor.yaml -o floor.exr --exr none,cryptomatte:8 --layer depth --method none --skip-existing --set 'objects[1].name=brick'
    expect 0 'nothing to render' render floor.yaml -o floor.exr --exr none,cryptomatte:8 --layer depth --method none --skip-existing
else
    echo "NOTICE: no python3 or no Embree here; mattes were not decoded"
fi
for word in cryptomatte:0 cryptomatte:17 cryptomatte: cryptomatte:4x cryptomatt; do
    expect 64 'allowed are float, half, .* or cryptomatte:N with N from 1 to 16' render "$simple" -o a.exr --exr $word
done

# Hashes: what --exr says changes them; the default of a whole picture does not.
expect 64 'exr is for .exr' render "$simple" -o a.png --exr half
expect 64 'allowed are float, half' render "$simple" -o a.exr --exr half,dwaa
expect 64 'allowed are float, half' render "$simple" -o a.exr --exr ''
works render "$simple" -o h.exr "${small[@]}" "${null[@]}" --quiet
expect 73 'was not rendered' render "$simple" -o h.exr "${small[@]}" "${null[@]}" --exr half --skip-existing
expect 0 'nothing to render' render "$simple" -o h.exr "${small[@]}" "${null[@]}" --exr float,zip --skip-existing

expect 64 'codec and --crf are for' render "$simple" -o a.y4m --codec h264
expect 64 'prores goes into .mov' render "$simple" -o a.mp4 --codec prores
expect 64 'crf is for h264 and hevc' render "$simple" -o a.mov --crf 3
expect 64 'allowed is h264, hevc or prores' render "$simple" -o a.mp4 --codec av1
expect 64 'allowed is a number from 0' render "$simple" -o a.mp4 --crf 52
if command -v ffprobe >/dev/null; then
    film() { # FILE codec,pixels [options]
        local file=$1 wanted=$2 found
        shift 2
        works render "$simple" -o "$file" --frames 0-3 "${small[@]}" --quiet "$@"
        found=$(ffprobe -v error -select_streams v:0 -show_entries stream=codec_name,pix_fmt,color_range,color_space,color_transfer,color_primaries,r_frame_rate -of csv=p=0 "$file")
        [[ $found == "$wanted,30/1" ]] || fail "$file: $found instead of $wanted,30/1"
        exists "$file.json"
    }
    film a.mp4 h264,yuv420p,tv,bt709,iec61966-2-1,bt709
    film best.mp4 h264,yuv420p,tv,bt709,iec61966-2-1,bt709 --crf 1
    film worst.mp4 h264,yuv420p,tv,bt709,iec61966-2-1,bt709 --crf 51
    (($(stat -c %s best.mp4) > $(stat -c %s a.mp4) && $(stat -c %s a.mp4) > $(stat -c %s worst.mp4))) || fail "--crf: $(stat -c %s best.mp4 a.mp4 worst.mp4)"
    film b.mov prores,yuv422p10le,tv,bt709,bt709,bt709
    if ffmpeg -v error -encoders | grep -q libx265; then
        film c.mp4 hevc,yuv420p10le,tv,bt709,iec61966-2-1,bt709 --codec hevc
        film d.mov hevc,yuv420p10le,tv,bt709,iec61966-2-1,bt709 --codec hevc --crf 20
        works render "$simple" -o again.mp4 --frames 0-3 "${small[@]}" --quiet --codec hevc
        same c.mp4 again.mp4
    fi
    works render "$simple" -o again.mov --frames 0-3 "${small[@]}" --quiet
    same b.mov again.mov
    expect 0 'nothing to render' render "$simple" -o b.mov --frames 0-3 "${small[@]}" --skip-existing
    expect 73 'was not rendered' render "$simple" -o a.mp4 --frames 0-3 "${small[@]}" --crf 17 --skip-existing
else
    echo "NOTICE: no ffprobe here; films were not looked at"
fi
finish
