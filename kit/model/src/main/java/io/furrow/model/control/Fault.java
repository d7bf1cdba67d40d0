package io.furrow.model.control;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.StateRecord;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A record of {@code service.faults}, under the name of a part of Furrow that fails or needs an operator. It is
 * repeated every minute; without repetition the fault is over.
 *
 * @param text what happened, to what, and what to do
 */
public record Fault(String text) implements StateRecord {
    /** @throws UnreadableException if the value is not an object with a {@code text} */
    public static Fault read(byte[] value) throws UnreadableException {
        JsonNode text = NgsiJson.read(value).path("text");
        Reason.NOT_AN_EVENT.refuseIf(!text.isTextual(), "the fault has no member 'text' with a text");
        return new Fault(text.textValue());
    }
}
