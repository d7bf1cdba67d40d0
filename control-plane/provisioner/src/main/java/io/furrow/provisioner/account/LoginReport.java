package io.furrow.provisioner.account;

import io.furrow.model.device.DeviceConnection.ForeignTopic;
import io.furrow.model.device.DeviceConnection.RefusedLogin;

/**
 * The observations of an MQTT broker about a user.
 *
 * @param loggedIn when the user last connected, epoch ms; null if never
 * @param refused null if no login was refused
 * @param foreign null if the user has not published to topics of others
 */
public record LoginReport(Long loggedIn, RefusedLogin refused, ForeignTopic foreign) {
    static final LoginReport NONE = new LoginReport(null, null, null);

    LoginReport loggedIn(long now) {
        return new LoginReport(now, refused, foreign);
    }

    LoginReport refused(String user, String reason, long now) {
        boolean continues = refused != null && (loggedIn == null || refused.last() > loggedIn);
        return new LoginReport(
                loggedIn, new RefusedLogin(continues ? refused.count() + 1 : 1, now, reason, user), foreign);
    }

    LoginReport published(String topic, long now) {
        return new LoginReport(
                loggedIn, refused, new ForeignTopic(foreign == null ? 1 : foreign.count() + 1, now, topic));
    }
}
