package io.furrow.model.event;

import java.util.LinkedHashMap;
import java.util.Map;

import io.furrow.model.ngsi.Reason;

/**
 * Input that was set aside: the original bytes are the value of a record on {@code <topic>.dead}, this is in its headers.
 *
 * @param message a sentence for people
 * @param stage who set it aside, for instance {@code ngsi-source}
 * @param source where it came from: {@code <topic>-<partition>@<offset>}, or the sender's address and path
 */
public record DeadLetter(Reason reason, String message, String stage, String source) {
    public static final String REASON = "dead-reason";
    public static final String MESSAGE = "dead-message";
    public static final String STAGE = "dead-stage";
    public static final String SOURCE = "dead-source";

    public Map<String, String> headers() {
        Map<String, String> headers = new LinkedHashMap<>();
        headers.put(REASON, reason.code());
        headers.put(MESSAGE, message);
        headers.put(STAGE, stage);
        headers.put(SOURCE, source);
        return headers;
    }
}
