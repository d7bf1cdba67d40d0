package io.furrow.connect.sink;

import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * What shall be written of one entity.
 *
 * @param attributes normalized, without what only the context broker sets
 * @param times the event time of each attribute
 * @param changes what it was made of, in the order of their arrival
 */
record Update(
        EntityKey key,
        String type,
        Map<String, ObjectNode> attributes,
        Map<String, Long> times,
        List<Change> changes) {}
