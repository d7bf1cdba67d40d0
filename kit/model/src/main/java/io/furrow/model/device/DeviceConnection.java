package io.furrow.model.device;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.ngsi.UnreadableException;

/**
 * What MQTT broker and IoT Agent know of a device, and thus why it may be silent: a record of {@code service.devices.connection}
 * under the key of {@code service.devices}, written by the provisioner. All times are epoch ms.
 *
 * @param since from when on logins were observed; null where nobody does
 * @param loggedIn when it last connected to the MQTT broker; null if it has not since then
 * @param refusedLogin null if none was refused
 * @param foreignTopic null if it has published to none
 * @param unreadablePayload null if all could be read, or where nobody says
 * @param registered whether the IoT Agent knows the device; null before it was asked
 */
public record DeviceConnection(
        Long since,
        Long loggedIn,
        RefusedLogin refusedLogin,
        ForeignTopic foreignTopic,
        UnreadablePayload unreadablePayload,
        Boolean registered)
        implements StateRecord {
    /** Reason of a refused login: there is no such user, or no longer. */
    public static final String UNKNOWN_USER = "unknown-user";
    /** Reason of a refused login: the user exists and has another password. */
    public static final String WRONG_PASSWORD = "wrong-password";

    /**
     * Logins that the MQTT broker refused since the last one that it accepted.
     *
     * @param reason {@link #UNKNOWN_USER} or {@link #WRONG_PASSWORD}
     * @param user of the last one
     */
    public record RefusedLogin(long count, long last, String reason, String user) {}

    /**
     * Messages to topics to which it may not publish.
     *
     * @param topic of the last one
     */
    public record ForeignTopic(long count, long last, String topic) {}

    /**
     * Messages that the IoT Agent could not read.
     *
     * @param reason why it could not read the last one
     * @param payload the first bytes of it
     */
    public record UnreadablePayload(long count, long last, String reason, String payload) {}

    /** @throws UnreadableException if it is no such record */
    public static DeviceConnection read(byte[] value) throws UnreadableException {
        try {
            return StateJson.readRecord(value, DeviceConnection.class);
        } catch (UnreadableException e) {
            throw new UnreadableException(Reason.NOT_JSON, "no record of a device's connection: " + e.getMessage(), e);
        }
    }
}
