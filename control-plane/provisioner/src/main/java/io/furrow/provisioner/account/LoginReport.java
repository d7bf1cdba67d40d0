package io.furrow.provisioner.account;

import io.furrow.model.device.DeviceConnection.ForeignTopic;
import io.furrow.model.device.DeviceConnection.RefusedLogin;

/**
 * What an MQTT broker noticed of a user.
 *
 * @param loggedIn when it last connected, epoch ms; null if it has not
 * @param refused null if no login was
 * @param foreign null if it has published to no topic of somebody else
 */
public record LoginReport(Long loggedIn, RefusedLogin refused, ForeignTopic foreign) {
    static final LoginReport NONE = new LoginReport(null, null, null);

    LoginReport loggedIn(long now) {
        return new LoginReport(now, refused, foreign);
    }

    LoginReport refused(String user, String reason, long now) {
        boolean goesOn = refused != null && (loggedIn == null || refused.last() > loggedIn);
        return new LoginReport(
                loggedIn, new RefusedLogin(goesOn ? refused.count() + 1 : 1, now, reason, user), foreign);
    }

    LoginReport published(String topic, long now) {
        return new LoginReport(
                loggedIn, refused, new ForeignTopic(foreign == null ? 1 : foreign.count() + 1, now, topic));
    }
}
