package io.furrow.ingest.route;

import io.furrow.flink.TopicRecord;

/**
 * An event as {@code ingest} sees it.
 *
 * @param id event id
 * @param identity tenant, service path and entity id
 * @param domain empty where the entity names none
 * @param mission empty where the entity names none
 */
public record ReportedEvent(String id, String identity, String domain, String mission, TopicRecord record) {}
