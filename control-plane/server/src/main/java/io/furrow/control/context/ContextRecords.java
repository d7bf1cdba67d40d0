package io.furrow.control.context;

import io.furrow.control.domain.Domain;
import io.furrow.control.manager.Records;
import io.furrow.control.mission.Mission;
import io.furrow.control.mission.MissionStatus;

/**
 * The stores of domains and missions, and of the entities published to the context broker.
 *
 * @param domains by name
 * @param missions by name
 * @param statuses by name of the mission
 * @param tallies by name of the mission
 * @param fields by id
 * @param outdated ids of entities that may have changed since they were published
 * @param told the entities as last published, by id
 */
record ContextRecords(
        Records<Domain> domains,
        Records<Mission> missions,
        Records<MissionStatus> statuses,
        Records<MissionTally> tallies,
        Records<FieldState> fields,
        Records<String> outdated,
        Records<byte[]> told) {}
