package io.furrow.model.event;

import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Set;

import io.furrow.model.ngsi.Reason;
import io.furrow.model.text.Utf8;

/**
 * Headers of rejected input: the value of a record on {@code <topic>.dead} has the original bytes.
 *
 * @param message a sentence for people, at most {@value #MAX_MESSAGE_LENGTH} characters
 * @param stage the part that rejected it, for instance {@code ngsi-source}
 * @param source its origin: {@code <topic>-<partition>@<offset>}, or the sender's address and path
 */
public record DeadLetter(Reason reason, String message, String stage, String source) {
    /** A message may quote megabytes of input. */
    private static final int MAX_MESSAGE_LENGTH = 500;

    public static final String REASON = "dead-reason";
    public static final String MESSAGE = "dead-message";
    public static final String STAGE = "dead-stage";
    public static final String SOURCE = "dead-source";
    /** Time of the original record, epoch ms, if the dead letter has another. */
    public static final String TIME = "dead-time";
    /** All headers that a dead letter adds to those of the original. */
    public static final Set<String> HEADERS = Set.of(REASON, MESSAGE, STAGE, SOURCE, TIME);

    public DeadLetter {
        String sentence = message == null ? reason.code() : message;
        message = Utf8.encodable(
                sentence.length() <= MAX_MESSAGE_LENGTH
                        ? sentence
                        : sentence.substring(0, MAX_MESSAGE_LENGTH - 1) + "…");
        source = source == null ? null : Utf8.encodable(source);
    }

    public Map<String, String> headers() {
        Map<String, String> headers = new LinkedHashMap<>();
        headers.put(REASON, reason.code());
        headers.put(MESSAGE, message);
        headers.put(STAGE, stage);
        headers.put(SOURCE, source);
        return headers;
    }
}
