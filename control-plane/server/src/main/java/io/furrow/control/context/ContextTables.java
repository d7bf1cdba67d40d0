package io.furrow.control.context;

import io.furrow.control.domain.Domain;
import io.furrow.control.manager.Table;
import io.furrow.control.mission.Mission;
import io.furrow.control.mission.MissionStatus;

/**
 * The stores of domains and missions, and of the entities published to the context broker.
 *
 * @param domains by name
 * @param missions by name
 * @param statuses by name of the mission
 * @param tallies by name of the mission
 * @param fields by tenant, service path and id
 * @param outdated ids of entities that may have changed since they were published
 * @param publishedEntities the entities as last published, by id
 */
record ContextTables(
        Table<Domain> domains,
        Table<Mission> missions,
        Table<MissionStatus> statuses,
        Table<MissionCounts> tallies,
        Table<FieldState> fields,
        Table<String> outdated,
        Table<byte[]> publishedEntities) {}
