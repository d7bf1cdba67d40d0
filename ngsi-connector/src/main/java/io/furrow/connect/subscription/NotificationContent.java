package io.furrow.connect.subscription;

import java.util.List;

import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * The content of a notification.
 *
 * @param attrs in this order, {@code *} and built-in ones among them
 * @param metadata of each attribute, {@code *} for all custom ones and built-in ones among them; empty for all custom
 *     ones
 * @param format {@code normalized}, {@code keyValues}, {@code simplifiedNormalized} or {@code simplifiedKeyValues}
 * @param onlyChanged only the attributes that changed
 */
public record NotificationContent(List<String> attrs, List<String> metadata, String format, boolean onlyChanged) {
    public NotificationContent {
        attrs = List.copyOf(attrs);
        metadata = List.copyOf(metadata);
    }

    /** With all custom metadata of the attributes. */
    public NotificationContent(List<String> attrs, String format, boolean onlyChanged) {
        this(attrs, List.of(), format, onlyChanged);
    }

    /** Whether a notification names its subscription. */
    public boolean namesItsSubscription() {
        return !format.startsWith("simplified");
    }

    void writeTo(ObjectNode notification) {
        attrs.forEach(notification.putArray("attrs")::add);
        if (!metadata.isEmpty()) {
            metadata.forEach(notification.putArray("metadata")::add);
        }
        notification.put("attrsFormat", format).put("onlyChangedAttrs", onlyChanged);
    }
}
