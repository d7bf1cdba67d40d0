package io.furrow.connect.broker;

import java.time.Duration;
import java.util.Optional;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.MissingNode;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/** The outcome of a request to a context broker. */
public sealed interface Outcome {
    /**
     * It was answered 2xx.
     *
     * @param headers of the answer
     * @param body as received, empty for 204
     */
    record Done(int status, ResponseHeaders headers, byte[] body) implements Outcome {
        /**
         * The body as JSON, a missing node if it is empty.
         *
         * @throws UnreadableException if it is not JSON
         */
        public JsonNode json() throws UnreadableException {
            return body.length == 0 ? MissingNode.getInstance() : NgsiJson.read(body);
        }

        /**
         * The body as a JSON array.
         *
         * @throws UnreadableException if it is not an array
         */
        public JsonNode list() throws UnreadableException {
            JsonNode list = json();
            if (!list.isArray()) {
                throw new UnreadableException(Reason.NOT_JSON, "the body of the answer is not a list");
            }
            return list;
        }
    }

    /** 404 of the context broker: a resource or the tenant does not exist. {@code words} are the status and the broker's reason. */
    record Absent(String words) implements Outcome {
        /** Whether NGSI-v2 says so of a resource, and not of the tenant. */
        public boolean isResourceOfV2() {
            return words.contains("\"NotFound\"");
        }
    }

    /**
     * The context broker rejects the request (any other 4xx), or its answer is larger than allowed (2xx). {@code words}
     * are the status and the reason.
     */
    record Rejected(int status, String words) implements Outcome {
        /** Whether a smaller request might succeed. */
        public boolean isTooLarge() {
            return status / 100 == 2;
        }
    }

    /**
     * There was no answer, or one that requests a retry (408, 425, 429, 5xx): the same request may succeed later.
     *
     * @param reason a sentence with the URL
     * @param retryAfter the pause that the broker requests, at least zero
     * @param cause null if there was an answer
     * @param status of the answer, 0 if there was none
     */
    record Unavailable(String reason, Optional<Duration> retryAfter, Throwable cause, int status) implements Outcome {}

    /**
     * No request can succeed until a setting is changed (401, 402, 403, 405, 407, 410, 421, 423, 451, 3xx, or the answer of
     * a proxy). {@code words} are the URL and the answer, which has the {@code status}.
     */
    record WrongSetting(int status, String words) implements Outcome {}
}
