package io.furrow.connect.subscription;

import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * Where notifications are sent.
 *
 * @param url of the source, as the context broker reaches it
 * @param headers sent besides the usual ones, a secret among them
 * @param maxFails failures in a row after which the context broker gives up; empty for never
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
