package io.furrow.mission;

import java.util.Map;

import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * An event of a mission as it is stored, in a document or in a line of an archive.
 *
 * @param id event id
 * @param time event time, epoch ms
 * @param entityId set also if there is no entity
 * @param headers of the record, including hop stamps, without the id, the time and the version of the envelope, which
 * are redundant
 * @param entity in normalized form; null if the event deletes the entity
 */
public record StoredEvent(String id, long time, String entityId, Map<String, String> headers, ObjectNode entity) {}
