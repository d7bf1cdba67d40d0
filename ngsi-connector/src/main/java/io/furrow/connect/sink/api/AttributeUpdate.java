package io.furrow.connect.sink.api;

import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * The values to write for one entity.
 *
 * @param attributes normalized, without members that only the context broker sets
 * @param times the event time of each attribute
 * @param changes the merged changes, in the order of their arrival
 */
record AttributeUpdate(
        EntityKey key,
        String type,
        Map<String, ObjectNode> attributes,
        Map<String, Long> times,
        List<EntityChange> changes) {}
