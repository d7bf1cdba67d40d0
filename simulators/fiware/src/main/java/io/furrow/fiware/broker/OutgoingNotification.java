package io.furrow.fiware.broker;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.model.ngsi.NgsiJson;

/**
 * A notification to be sent.
 *
 * @param correlator value of the header {@code Fiware-Correlator}
 */
record OutgoingNotification(Subscription subscription, EntityChange change, String correlator) {
    /** {@code {subscriptionId, data: [entity]}}, or the bare entity in the simplified formats, as UTF-8 JSON. */
    byte[] body() {
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
