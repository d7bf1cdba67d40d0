package io.furrow.connect.broker;

import java.util.ArrayDeque;
import java.util.Arrays;
import java.util.Deque;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.BiFunction;
import java.util.regex.Pattern;

import static java.nio.charset.StandardCharsets.ISO_8859_1;
import static java.nio.charset.StandardCharsets.UTF_8;

/**
 * Answers that a fuzzer makes up. They are separated by the byte 0xff; the low four bits of the first byte pick the status, lines
 * up to an empty one are headers, the rest is the body. Without an empty line all of it is the body.
 */
public final class Script {
    /** One answer. */
    public record Reply(int status, Map<String, List<String>> headers, byte[] body) {
        public static Reply of(int status, String body) {
            return new Reply(status, Map.of(), body.getBytes(UTF_8));
        }
    }

    private static final int[] STATUSES = {
        200, 201, 204, 207, 301, 400, 401, 404, 405, 408, 409, 413, 422, 429, 500, 503
    };
    private static final byte SEPARATOR = (byte) 0xff;
    private static final Pattern HEADER = Pattern.compile("([A-Za-z-]{1,40}): ?(\\P{Cntrl}{0,200})");

    private final Deque<Reply> replies = new ArrayDeque<>();
    private final BiFunction<String, String, Reply> afterwards;

    /** @param afterwards what is answered to a method and a path when the script is over */
    public Script(byte[] input, BiFunction<String, String, Reply> afterwards) {
        this.afterwards = afterwards;
        int start = 0;
        for (int i = 0; i <= input.length; i++) {
            if (i == input.length || input[i] == SEPARATOR) {
                if (i > start) {
                    replies.add(reply(Arrays.copyOfRange(input, start, i)));
                }
                start = i + 1;
            }
        }
    }

    Reply next(String method, String path) {
        return replies.isEmpty() ? afterwards.apply(method, path) : replies.remove();
    }

    private static Reply reply(byte[] input) {
        int status = STATUSES[input[0] & 15];
        String text = new String(input, 1, input.length - 1, ISO_8859_1);
        int end = text.indexOf("\n\n");
        Map<String, List<String>> headers = new TreeMap<>(String.CASE_INSENSITIVE_ORDER);
        if (end >= 0) {
            for (String line : text.substring(0, end).split("\n")) {
                var header = HEADER.matcher(line);
                if (header.matches()) {
                    headers.put(header.group(1), List.of(header.group(2)));
                }
            }
        }
        int body = end < 0 ? 1 : 1 + end + 2;
        return new Reply(status, headers, status == 204 ? new byte[0] : Arrays.copyOfRange(input, body, input.length));
    }
}
