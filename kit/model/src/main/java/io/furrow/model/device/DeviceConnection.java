package io.furrow.model.device;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The state of a device at the MQTT broker and the IoT Agent, which explains its silence: a record of {@code
 * service.devices.connection} under the key of {@code service.devices}, written by the provisioner. All times are epoch
 * ms.
 *
 * @param since when the observation of logins began; null if they are not observed
 * @param loggedIn last connection to the MQTT broker; null if there was none
 * @param refusedLogin null if there was none
 * @param foreignTopic null if there was none
 * @param unreadablePayload null if there was none or it is not reported
 * @param registered whether the IoT Agent has the device; null before the first check
 */
public record DeviceConnection(
        Long since,
        Long loggedIn,
        RefusedLogin refusedLogin,
        ForeignTopic foreignTopic,
        UnreadablePayload unreadablePayload,
        Boolean registered)
        implements StateRecord {
    /** Reason of a rejected login: the user does not exist. */
    public static final String UNKNOWN_USER = "unknown-user";
    /** Reason of a rejected login: the user has another password. */
    public static final String WRONG_PASSWORD = "wrong-password";

    /**
     * Logins that the MQTT broker has rejected since the last accepted one.
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
     * @param reason of the last failure
     * @param payload the first bytes of the last one
     */
    public record UnreadablePayload(long count, long last, String reason, String payload) {}

    /** @throws UnreadableException if it is not such a record */
    public static DeviceConnection read(byte[] value) throws UnreadableException {
        try {
            return StateJson.readRecord(value, DeviceConnection.class);
        } catch (UnreadableException e) {
            throw new UnreadableException(
                    Reason.NOT_JSON, "not a record of a device's connection: " + e.getMessage(), e);
        }
    }
}
