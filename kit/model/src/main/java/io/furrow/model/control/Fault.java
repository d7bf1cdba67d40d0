package io.furrow.model.control;

import java.util.Map;
import java.util.TreeMap;

import com.fasterxml.jackson.annotation.JsonInclude;
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
 * @param code kind of fault; null if a record of an older version names none
 * @param values names and numbers in the text, by name, from which a client can write it in another language
 */
public record Fault(
        String text,
        String code,
        @JsonInclude(JsonInclude.Include.NON_EMPTY) Map<String, String> values) implements StateRecord {
    /** @throws UnreadableException if the value is not an object with a {@code text} */
    public static Fault read(byte[] value) throws UnreadableException {
        JsonNode fault = NgsiJson.read(value);
        JsonNode text = fault.path("text");
        Reason.NOT_AN_EVENT.refuseIf(!text.isTextual(), "the fault has no member 'text' with a text");
        Map<String, String> values = new TreeMap<>();
        fault.path("values")
                .properties()
                .forEach(each -> values.put(each.getKey(), each.getValue().asText()));
        return new Fault(text.textValue(), fault.path("code").textValue(), values);
    }
}
