/* SPDX-License-Identifier: MIT
 *
 * What the page can set: one row a setting. The page's controls, links and commands, and the scene here, read the rows in this order.
 *
 * SETTING(name, label, unit, least, most, step, preset, place): `place` is where the command has it, "sea KEY" for a word of --sea, "set KEY" for --set,
 * "" for what the page says in another way. Steps say how many decimals a value keeps. A least value above 0 with a step of 0 has a slider of octaves.
 * What has no unit and a step of 1 or more is a whole number.
 */
SETTING(wind, "Wind", "m/s", 0.5, 33, 0.5, 8, "sea wind")
SETTING(direction, "Wind from", "°", -180, 180, 1, 0, "sea direction")
SETTING(fetch, "Fetch", "km", 0, 1000, 1, 0, "sea fetch")
SETTING(swell, "Swell", "m", 0, 8, 0.1, 0, "sea swell")
SETTING(swell_period, "Swell period", "s", 4, 20, 0.5, 12, "sea swell_period")
SETTING(swell_direction, "Swell from", "°", -180, 180, 1, 0, "sea swell_direction")
SETTING(seed, "Another sea", "", 1, 99, 1, 1, "sea seed")
SETTING(waves, "Waves", "", 16, 1024, 8, 160, "sea count")
SETTING(choppiness, "Choppiness", "", 0, 1, 0.05, 0.7, "set water.choppiness")
SETTING(foam, "Foam", "×", 0, 4, 0.1, 1, "set water.foam.amount")
SETTING(moon, "Moon", "", 0, 1, 1, 0, "set light.body")
SETTING(elevation, "Height", "°", -2, 85, 0.1, 12, "set light.elevation_deg")
SETTING(azimuth, "Direction", "°", -180, 180, 0.1, 0, "set light.azimuth_deg")
SETTING(turbidity, "Haze", "", 1, 10, 0.1, 1.8, "set sky.turbidity")
SETTING(height, "Height", "m", 0.5, 200, 0.1, 3, "")
SETTING(pitch, "Look up", "°", -85, 30, 0.1, -7, "")
SETTING(heading, "Look to", "°", -180, 180, 0.1, 0, "")
SETTING(fov, "Field of view", "°", 10, 110, 1, 50, "set camera.fov_y_deg")
SETTING(time, "Time", "s", 0, 3600, 0.001, 10, "set time.start")
SETTING(shutter, "Shutter", "frames", 0, 1, 0.05, 0.5, "set time.shutter")
SETTING(exposure, "Exposure", "stops", -5, 5, 0.1, 0, "set post.exposure_offset")
