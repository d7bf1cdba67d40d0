package io.furrow.model.device;

import java.util.Objects;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.control.Limits;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.Coded;

/**
 * The status of a device, reported by its host: a record of {@code service.devices.status} under the key of {@code
 * service.devices}.
 *
 * @param sequence of the desired state to which it refers; an older one than the newest desired state does not describe
 * it
 * @param reason why it failed, at most {@value Limits#REASON_LENGTH} characters; null if it did not
 */
public record DeviceStatus(long sequence, State state, String reason) implements StateRecord {
    /** The state of a device. */
    public enum State implements Coded {
        RUNNING,
        STOPPED,
        FAILED;
    }

    public DeviceStatus {
        Objects.requireNonNull(state);
    }

    /**
     * Reads the value of a record; unknown members are ignored.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON}, or {@link Reason#NOT_AN_EVENT} if it is not such an
     * object
     */
    public static DeviceStatus read(byte[] value) throws UnreadableException {
        JsonNode json = NgsiJson.read(value);
        JsonNode sequence = json.path("sequence");
        Reason.NOT_AN_EVENT.refuseIf(
                !sequence.isIntegralNumber() || !sequence.canConvertToLong(),
                "'sequence' of the status is not a whole number");
        State state = Coded.find(State.values(), json.path("state").textValue())
                .orElseThrow(() -> new UnreadableException(
                        Reason.NOT_AN_EVENT, "'state' of the status is not running, stopped or failed"));
        return new DeviceStatus(
                sequence.longValue(), state, Limits.reason(json.path("reason").textValue()));
    }
}
