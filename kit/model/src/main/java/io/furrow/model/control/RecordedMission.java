package io.furrow.model.control;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A record of {@code service.recordings} under the mission's name: the mission is stored and can be played back.
 *
 * @param first event time of its oldest event at the last check, epoch ms
 * @param last event time of its newest event, epoch ms, inclusive
 * @param events how many it had at that check, as MongoDB remembers it
 */
public record RecordedMission(String mission, long first, long last, long events) implements StateRecord {
    /**
     * Reads the value of a record; unknown members are ignored.
     *
     * @throws UnreadableException with {@link Reason#NOT_JSON}, or {@link Reason#NOT_AN_EVENT} if it is not such an
     * object
     */
    public static RecordedMission read(byte[] value) throws UnreadableException {
        if (!(NgsiJson.read(value) instanceof ObjectNode json)) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, "it is not an object");
        }
        JsonObjectReader members = new JsonObjectReader(json);
        try {
            return new RecordedMission(
                    members.text("mission"),
                    members.number("first"),
                    members.number("last"),
                    members.has("events") ? members.number("events") : 0);
        } catch (RejectedException e) {
            throw new UnreadableException(Reason.NOT_AN_EVENT, e.getMessage());
        }
    }
}
