package io.furrow.model.event;

import java.nio.charset.StandardCharsets;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.Set;

import io.furrow.model.ngsi.Reason;

/**
 * Input that was set aside: the original bytes are the value of a record on {@code <topic>.dead}, this is in its headers.
 *
 * @param message a sentence for people, at most {@value #MAX_MESSAGE_LENGTH} signs
 * @param stage who set it aside, for instance {@code ngsi-source}
 * @param source where it came from: {@code <topic>-<partition>@<offset>}, or the sender's address and path
 */
public record DeadLetter(Reason reason, String message, String stage, String source) {
    /** A sentence may quote the input, which may be megabytes. */
    private static final int MAX_MESSAGE_LENGTH = 500;

    public static final String REASON = "dead-reason";
    public static final String MESSAGE = "dead-message";
    public static final String STAGE = "dead-stage";
    public static final String SOURCE = "dead-source";
    /** Time of the original record, epoch ms, where the letter has another. */
    public static final String TIME = "dead-time";
    /** All headers of a dead letter that the original did not have. */
    public static final Set<String> HEADERS = Set.of(REASON, MESSAGE, STAGE, SOURCE, TIME);

    public DeadLetter {
        String sentence = message == null ? reason.code() : message;
        message = unicode(
                sentence.length() <= MAX_MESSAGE_LENGTH
                        ? sentence
                        : sentence.substring(0, MAX_MESSAGE_LENGTH - 1) + "…");
        source = unicode(source);
    }

    /** Half of a surrogate pair, quoted from the input or left by cutting it, has no UTF-8 form, which a header must have. */
    private static String unicode(String text) {
        if (text == null || StandardCharsets.UTF_8.newEncoder().canEncode(text)) {
            return text;
        }
        return text.codePoints()
                .map(sign -> sign >= Character.MIN_SURROGATE && sign <= Character.MAX_SURROGATE ? 0xfffd : sign)
                .collect(StringBuilder::new, StringBuilder::appendCodePoint, StringBuilder::append)
                .toString();
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
