# SPDX-License-Identifier: MIT
# Every control changes what is seen, is undone and redone to the same bytes. Each is tried in a state where it matters; a control that no state below covers fails the test.
. "$CHECK"

cat >scene.yaml <<'END'
mangata: 1
image: {width: 256, height: 144}
camera: {position: [0, 3, 0], target: [0, 2.6, -1]}
light: {elevation_deg: 15, angular_radius_deg: 1}
time: {start: 1, frames: 30}
water:
  waves:
    - {amplitude: 0.05, a: 1.5, b: 0.7, c: -4}
    - {amplitude: 0.03, a: -2, b: 1.1, c: -4.5}
    - {amplitude: 0.005, a: 9, b: 6, c: -10}
END
size=(--size 480x270)

drive scene.yaml "${size[@]}" <<'END'
list-controls
quit
END
sed 's/=.*//' stdout.txt | sort >all.txt
(($(wc -l <all.txt) > 60)) || fail "only $(wc -l <all.txt) controls"

# vary NAME…: all in the state that the commands before have made.
vary() {
    local name
    for name; do
        echo "vary $name"
        echo "$name" >>varied.txt
    done
}
# change NAME VALUE: the same with this value.
change() {
    printf '%s\n' mark "set $1 $2" expect-change undo expect-same redo expect-change "expect-value $1 $2" undo
    echo "$1" >>varied.txt
}
pattern() { grep -E "$1" all.txt; }

{
    echo 'set view.resolution full'
    vary $(pattern '^light\.' | grep -v azimuth) light.azimuth_deg sky.model sky.turbidity water.choppiness water.ior water.body_albedo
    # a wind, a spectrum and a swell in place of the waves
    echo 'set view.resolution third'
    change water.wind.speed 9
    echo 'set water.wind.speed 9'
    vary water.wind.direction_deg water.wind.fetch water.wind.depth water.wind.count water.wind.seed water.foam.amount
    printf '%s\n' 'set water.wind.speed 0' mark 'set water.spectrum.model jonswap' expect-change undo expect-same redo
    echo water.spectrum.model >>varied.txt
    vary $(pattern '^water\.spectrum' | grep -v 'model\|spread')
    echo 'set water.spectrum.directions fixed'
    vary water.spectrum.spread
    echo 'set water.swell [{height: 1, period: 6, count: 20}]'
    for key in height period direction_deg spread count seed; do vary "water.swell[0].$key"; done
    printf '%s\n' 'set water.swell []' 'set water.spectrum.model none' revert 'set view.resolution third'
    # objects, and what shows with them alone
    echo 'set objects [{shape: plane, size: [20, 1, 20], position: [0, -1, -3]}, {shape: box, size: [1, 1, 1], position: [0, 0.4, -4]}]'
    for key in position rotation_deg scale size material.base_color material.roughness material.metallic; do vary "objects[1].$key"; done
    echo 'set objects[1].material.pattern tiles'
    for key in pattern pattern_color pattern_size pattern_joint; do vary "objects[1].material.$key"; done
    vary a.refraction a.caustics a.tess_error
    printf '%s\n' 'set a.refraction truth'
    vary a.refraction_samples
    printf '%s\n' 'set a.refraction two-phase' revert 'set view.resolution full' 'set water.choppiness 0.7'
    vary water.foam.share
    echo 'set water.foam.share 0.3'
    vary water.foam.persistence
    echo 'set water.foam.share 0'
    echo 'set water.choppiness 0'
    echo 'set camera.position [0, 900, 0]'
    change sky.aerial on # auto is off without a wind
    echo 'set camera.position [0, 3, 0]'
    echo 'set light.body moon'
    echo 'set camera.target [0, 8, -10]'
    change sky.stars on # auto is off without a wind
    change post.night_tint on
    echo 'set camera.target [0, 3, -10]'
    echo 'set light.body sun'
    vary post.exposure post.exposure_offset post.tone_map post.glare
    vary camera.position camera.target camera.fov_y_deg time.shutter time.fps clock.time
    vary $(pattern '^water\.waves\[[0-9]+\]')
    vary water.amplitude
    change waves.count 1 # most counts are above three
    vary a.method view.compare view.layer view.zoom view.resolution
    echo 'set camera.position [0, 3, 0]'
    vary camera.up panel.shown panel.keys panel.log panel.inspector panel.scale
    printf '%s\n' mark 'set panel.timings on' expect-change undo expect-same redo 'expect-value panel.timings on' undo # never shows the same times
    echo panel.timings >>varied.txt
    # what counts in some states only
    echo 'set camera.position [0, -2, 0]'
    vary water.absorption water.scattering
    echo 'set camera.position [0, 3, 0]'
    vary water.level
    echo 'set water.level 0'
    echo 'set sky.model gradient'
    vary sky.zenith sky.horizon
    echo 'set sky.model atmosphere'
    echo 'set light.elevation_deg -40'
    vary sky.night
    echo 'set light.elevation_deg 15'
    echo 'set view.zoom 3'
    vary view.center_x view.center_y
    echo 'set view.zoom 1'
    echo 'set view.frame scene'
    vary image.width image.height
    echo 'set view.frame fill'
    vary view.frame
    echo 'wipe none mangata 0.5'
    vary view.wipe b.method
    echo 'set view.compare difference'
    vary view.difference_scale panel.legend
    echo 'set view.compare off'
    echo 'set view.layer depth'
    vary view.near_depth view.far_depth
    echo 'set view.layer coverage'
    vary view.coverage_end
    echo 'set view.layer normal'
    vary view.lean_end
    echo 'set view.layer color'
    echo 'set a.method podee-pixel'
    vary a.ndf_mean a.kernels a.transition a.path_segments
    echo 'set a.transition soft'
    vary a.transition_width
    printf 'set a.%s\n' 'method reference' 'spatial 1' 'time_samples 2'
    vary a.light_cells
    echo 'set a.method ggx-moments'
    vary a.roughness_floor
    echo 'set a.method adaptive'
    vary a.adaptive
    echo 'set a.adaptive cells'
    vary a.samples a.target_rmse a.target_displayed
    echo 'set a.samples 4'
    echo 'set a.adaptive podee'
    vary a.importance_center a.importance_width a.importance_threshold a.slots
    # what shows for long ellipses, or as the machine has it
    printf 'a.%s\n' elongation budget_ms >>varied.txt
    # side B has the same rows
    pattern '^b\.' | grep -v 'method\|ndf_mean\|spatial\|seed\|time_samples' >>varied.txt
    printf 'set a.%s\n' 'method ssaa' 'spatial 2' 'time_samples 2'
    vary a.spatial a.seed a.time_samples
    echo 'set a.method mangata'
    echo 'wipe mangata podee-pixel 0.2'
    vary b.ndf_mean
    printf 'set b.%s\n' 'method ssaa' 'spatial 2' 'time_samples 2'
    vary b.spatial b.seed b.time_samples
    echo 'set view.compare off'
    echo 'set panel.inspector on'
    vary inspect.x inspect.y
    echo 'set panel.inspector off'
    # shown by the panel's pages, not by the picture
    printf '%s\n' 'set view.resolution quarter' 'resize 1000 700'
    echo 'page 3'
    vary move.mode move.path move.speed move.clearance
    echo 'page 4'
    vary time.start time.frames panel.judge
    vary clock.speed clock.loop
    # a path
    echo 'set move.path on'
    echo 'set camera.path [{time: 0, position: [0, 3, 0], target: [0, 2, -5]}, {time: 2, position: [2, 3, 0], target: [1, 2, -5]}]'
    for key in time position target up fov_y_deg; do echo "vary camera.path[0].$key"; done
    # a running clock: the next frames are others
    echo 'mark'
    echo 'set clock.play on'
    echo 'frames 3'
    echo 'set clock.play off'
    echo 'expect-change'
    echo clock.play >>varied.txt
    echo quit
} >vary.txt
drive scene.yaml "${size[@]}" <vary.txt
sort -u varied.txt >covered.txt
grep -v '^water\.swell\[\|^objects\[' covered.txt >named.txt # of the swell and the objects that were added
missing=$(comm -23 all.txt covered.txt)
[[ -z $missing ]] || fail "not covered: $missing"
unknown=$(comm -13 all.txt named.txt)
[[ -z $unknown ]] || fail "no such controls: $unknown"
finish
