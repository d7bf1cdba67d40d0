package io.furrow.connect.subscription;

import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * The receiver of notifications.
 *
 * @param url of the source, as reached by the context broker
 * @param headers sent besides the usual ones, including a secret
 * @param maxFails failures in a row after which the context broker stops; empty for never
 */
public record Target(String url, Map<String, String> headers, Optional<Integer> maxFails) {
    public Target {
        headers = new TreeMap<>(headers);
    }

    void writeTo(ObjectNode notification) {
        if (headers.isEmpty()) {
            notification.putObject("http").put("url", url);
        } else {
            ObjectNode custom = notification.putObject("httpCustom").put("url", url);
            ObjectNode all = JsonNodeFactory.instance.objectNode();
            headers.forEach(all::put);
            custom.set("headers", all);
        }
        maxFails.ifPresent(limit -> notification.put("maxFailsLimit", limit));
    }

    /** Without the values of headers. */
    @Override
    public String toString() {
        return "Target[url=" + url + ", headers=" + headers.keySet() + ", maxFails=" + maxFails + "]";
    }
}
