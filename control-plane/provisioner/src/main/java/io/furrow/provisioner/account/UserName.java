package io.furrow.provisioner.account;

import java.util.regex.Matcher;
import java.util.regex.Pattern;

/**
 * The parts of a user name of this farm, see {@link io.furrow.model.device.FarmSecret#device(String, String, int)}.
 *
 * @param owner device or mission, the name without key and generation
 * @param key of the secret; -1 for a foreign user
 * @param generation how often the device's credentials were rotated
 */
record UserName(String owner, int key, int generation) {
    private static final Pattern DEVICE = Pattern.compile("(furrow\\.d\\.[^.]+\\.[^.]+)\\.(\\d{1,9})\\.(\\d{1,9})");
    private static final Pattern MISSION = Pattern.compile("(furrow\\.m\\.[^.]+)\\.(\\d{1,9})");

    static UserName of(String user) {
        Matcher device = DEVICE.matcher(user);
        if (device.matches()) {
            return new UserName(device.group(1), Integer.parseInt(device.group(2)), Integer.parseInt(device.group(3)));
        }
        Matcher mission = MISSION.matcher(user);
        return mission.matches()
                ? new UserName(mission.group(1), Integer.parseInt(mission.group(2)), 0)
                : new UserName(user, -1, 0); // an edited section
    }
}
