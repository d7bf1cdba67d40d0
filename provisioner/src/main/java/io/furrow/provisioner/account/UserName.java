package io.furrow.provisioner.account;

import io.furrow.model.device.FarmSecret;

/**
 * What the name of a user of ours says, see {@link FarmSecret#device(String, String, int)}.
 *
 * @param owner device or mission, the name without key and generation
 * @param generation how often the device's credentials were rotated
 */
record UserName(String owner, int generation) {
    private static final String DEVICE = FarmSecret.USER_PREFIX + "d.";

    static UserName of(String user) {
        int end = user.lastIndexOf('.');
        int key = user.lastIndexOf('.', end - 1);
        try {
            return user.startsWith(DEVICE)
                    ? new UserName(user.substring(0, key), Integer.parseInt(user.substring(end + 1)))
                    : new UserName(user.substring(0, Math.max(0, end)), 0);
        } catch (IndexOutOfBoundsException | NumberFormatException e) { // somebody has edited the line
            return new UserName(user, 0);
        }
    }
}
