package io.furrow.control.domain;

import java.util.List;
import java.util.Objects;
import java.util.function.Function;
import java.util.stream.Stream;

import io.furrow.control.manager.ManagerTopic;
import io.furrow.control.manager.ManagerTopology;
import io.furrow.control.manager.Quota;
import io.furrow.control.manager.Sequence;
import io.furrow.control.manager.Table;
import io.furrow.control.manager.UnitOfWork;
import io.furrow.model.control.Limits;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

/**
 * Processes requests on {@code service.domainmanager} and maintains {@code service.domains}. It shares its stores with
 * the mission manager, in one task, so that no mission starts in a domain while the domain is deleted.
 */
public final class DomainManager {
    private static final String DOMAINS = "domains";
    private static final String SEQUENCE = "farm-sequence";
    /** A global store, which processors need not name. */
    private static final String FIELDS = "fields";

    private DomainManager() {}

    /** Creates a handler on the stores of a processor. */
    public static DomainCommandHandler handler(UnitOfWork unitOfWork, DomainMissions missions) {
        Table<FieldVersion> fields = unitOfWork.table(FIELDS, FieldVersion::toBytes, DomainManager::readable);
        DomainCommandHandler.Dependencies dependencies = new DomainCommandHandler.Dependencies(
                sequence(unitOfWork), quota(unitOfWork), () -> fields.where(Objects::nonNull));
        return new DomainCommandHandler(domains(unitOfWork), missions, dependencies, unitOfWork);
    }

    /** Returns null for an unreadable value; the jobs report it. */
    private static FieldVersion readable(byte[] value) {
        try {
            return FieldVersion.read(value);
        } catch (UnreadableException e) {
            return null;
        }
    }

    /** Names of the stores that other processors may use. */
    public static List<String> stores() {
        return List.of(DOMAINS, SEQUENCE);
    }

    /** Returns the stored domains, for a processor connected to {@link #stores()}. */
    public static Table<Domain> domains(UnitOfWork unitOfWork) {
        return unitOfWork.table(DOMAINS, Domain.class);
    }

    /** Returns the shared sequence of the desired state of domains, missions and devices. */
    public static Sequence sequence(UnitOfWork unitOfWork) {
        return new Sequence(unitOfWork.table(SEQUENCE, Long.class));
    }

    /** Returns the quota shared by all definitions of domains, missions and templates. */
    public static Quota quota(UnitOfWork unitOfWork) {
        return new Quota(unitOfWork.table(SEQUENCE, Long.class), Limits.DEFINITIONS_BYTES);
    }

    /** @param missions creates the access to missions, which needs further stores; these and {@link #stores()} must exist already */
    public static void add(
            ManagerTopology topology, Function<UnitOfWork, DomainMissions> missions, List<String> storesOfMissions) {
        topology.addGlobalStore(FIELDS, Topics.FIELDS);
        topology.addManager(
                ManagerTopic.DOMAIN,
                unitOfWork -> handler(unitOfWork, missions.apply(unitOfWork)),
                Stream.concat(stores().stream(), storesOfMissions.stream()).toList());
    }
}
