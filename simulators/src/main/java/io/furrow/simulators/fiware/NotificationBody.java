package io.furrow.simulators.fiware;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;

/** What a notification says: {@code {subscriptionId, data: [entity]}}, or the bare entity in the simplified forms. */
final class NotificationBody {
    private NotificationBody() {}

    /** UTF-8 JSON. */
    static byte[] of(Subscription subscription, Change change) {
        SubscriptionDefinition definition = subscription.definition();
        JsonNode entity = definition.rendering().of(change, definition.onlyChanged());
        if (definition.rendering().format().isBare()) {
            return NgsiJson.write(entity);
        }
        ObjectNode body = JsonNodeFactory.instance.objectNode().put("subscriptionId", subscription.id());
        body.putArray("data").add(entity);
        return NgsiJson.write(body);
    }
}
