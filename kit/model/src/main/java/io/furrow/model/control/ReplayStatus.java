package io.furrow.model.control;

import java.util.Locale;
import java.util.Objects;

import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.StateJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * The status of a replay, reported by its player: a record of {@code service.replays.status} under the replay's name.
 *
 * @param sequence of the desired state that was applied last
 * @param reason why it ended or failed, at most {@value Limits#REASON_LENGTH} characters; null if there is none
 * @param settled whether no restart can revert the state; the end of a replay is reported at once, and again when it is
 * settled
 * @param progress null if it is not reported
 */
public record ReplayStatus(long sequence, State state, String reason, boolean settled, Progress progress) {
    private static final String SEQUENCE = "sequence";
    private static final String STATE = "state";
    private static final String REASON = "reason";
    private static final String SETTLED = "settled";
    private static final String PROGRESS = "progress";

    /** The state of a replay. */
    public enum State {
        RUNNING,
        PAUSED,
        ENDED,
        STOPPED,
        FAILED;

        /** Returns whether the replay is over. */
        public boolean isOver() {
            return this == ENDED || this == STOPPED || this == FAILED;
        }

        /** Returns the text of the state in the record. */
        public String code() {
            return name().toLowerCase(Locale.ROOT);
        }
    }

    /**
     * The progress of a replay. Counts are those of the epoch.
     *
     * @param epoch 0, then one more with each restart
     * @param position reached original event time, epoch ms
     * @param from event time of the mission's first event, epoch ms
     * @param to event time of the mission's last event, epoch ms
     * @param offset ms that record timestamps are ahead of original times
     * @param latenessMillis maximum delay of an event behind its schedule since the last status
     * @param slipMillis delay of the epoch's schedule because the recording was unavailable; lateness is relative to
     * the delayed schedule
     * @param eventsPerSecond since the last status
     * @param events number of played events
     * @param primes number of played primes
     * @param skipped stored documents without a valid event
     * @param waiting what the replay waits for, in a sentence; null if it does not wait
     */
    public record Progress(
            long epoch,
            long position,
            long from,
            long to,
            long offset,
            @JsonProperty("lateness") long latenessMillis,
            @JsonProperty("slip") long slipMillis,
            @JsonProperty("rate") double eventsPerSecond,
            long events,
            long primes,
            long skipped,
            String waiting) {
        public Progress {
            waiting = Limits.reason(waiting);
        }

        private static Progress read(JsonNode json) {
            return new Progress(
                    json.path("epoch").asLong(), json.path("position").asLong(),
                    json.path("from").asLong(), json.path("to").asLong(),
                    json.path("offset").asLong(), json.path("lateness").asLong(),
                    json.path("slip").asLong(), json.path("rate").asDouble(),
                    json.path("events").asLong(), json.path("primes").asLong(),
                    json.path("skipped").asLong(), json.path("waiting").textValue());
        }
    }

    public ReplayStatus {
        Objects.requireNonNull(state);
    }

    /**
     * Reads the value of a record; unknown members are ignored. A missing {@code settled} counts as true.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON}, or {@link Reason#NOT_AN_EVENT} if it is not such an
     * object
     */
    public static ReplayStatus read(byte[] value) throws UnreadableException {
        JsonNode json = NgsiJson.read(value);
        JsonNode sequence = json.path(SEQUENCE);
        Reason.NOT_AN_EVENT.refuseIf(
                !sequence.isIntegralNumber() || !sequence.canConvertToLong(),
                "'sequence' of the status is not a whole number");
        for (State state : State.values()) {
            if (state.code().equals(json.path(STATE).textValue())) {
                return new ReplayStatus(
                        sequence.longValue(),
                        state,
                        Limits.reason(json.path(REASON).textValue()),
                        json.path(SETTLED).asBoolean(true),
                        json.path(PROGRESS).isObject() ? Progress.read(json.path(PROGRESS)) : null);
            }
        }
        throw new UnreadableException(
                Reason.NOT_AN_EVENT, "'state' of the status is not running, paused, ended, stopped or failed");
    }

    public byte[] toBytes() {
        ObjectNode json = NgsiJson.object();
        json.put(SEQUENCE, sequence).put(STATE, state.code());
        DeviceGroup.put(json, REASON, Limits.reason(reason));
        if (state.isOver()) {
            json.put(SETTLED, settled);
        }
        if (progress != null) {
            json.set(PROGRESS, StateJson.tree(progress));
        }
        return NgsiJson.write(json);
    }
}
