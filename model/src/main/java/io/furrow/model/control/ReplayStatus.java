package io.furrow.model.control;

import java.util.Locale;
import java.util.Objects;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * What a replay is, told by whoever plays it back: a record of {@code service.replays.status} under the replay's name.
 *
 * @param sequence of the wanted replay that was applied last
 * @param reason why it failed, at most {@value Limits#REASON_LENGTH} characters of it; null where it did not
 */
public record ReplayStatus(long sequence, State state, String reason) {
    /** How it is with a replay. */
    public enum State {
        RUNNING,
        PAUSED,
        ENDED,
        STOPPED,
        FAILED;

        /** Whether nothing will come of it any more. */
        public boolean isOver() {
            return this == ENDED || this == STOPPED || this == FAILED;
        }

        /** As the record has it. */
        public String word() {
            return name().toLowerCase(Locale.ROOT);
        }
    }

    public ReplayStatus {
        Objects.requireNonNull(state);
    }

    /**
     * Reads the value of a record; members of other names are passed over.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON}, or {@link Reason#NOT_AN_EVENT} where it is no such object
     */
    public static ReplayStatus read(byte[] value) throws UnreadableException {
        JsonNode json = NgsiJson.read(value);
        JsonNode sequence = json.path("sequence");
        if (!sequence.isIntegralNumber() || !sequence.canConvertToLong()) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "'sequence' of the status is no whole number");
        }
        for (State state : State.values()) {
            if (state.word().equals(json.path("state").textValue())) {
                return new ReplayStatus(
                        sequence.longValue(),
                        state,
                        Limits.reason(json.path("reason").textValue()));
            }
        }
        throw new UnreadableException(
                Reason.NOT_AN_EVENT, "'state' of the status is not running, paused, ended, stopped or failed");
    }

    public byte[] toBytes() {
        ObjectNode json = JsonNodeFactory.instance.objectNode();
        json.put("sequence", sequence).put("state", state.word());
        DeviceGroup.put(json, "reason", reason);
        return NgsiJson.write(json);
    }
}
