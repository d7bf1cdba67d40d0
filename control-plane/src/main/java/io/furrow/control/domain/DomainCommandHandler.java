package io.furrow.control.domain;

import java.util.List;

import io.furrow.control.manager.EventPublisher;
import io.furrow.control.manager.Quota;
import io.furrow.control.manager.record.Records;
import io.furrow.control.manager.record.Sequence;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.RefusedException;
import io.furrow.model.topic.Topics;

/** Executes or rejects commands on domains. A rejected command changes nothing. */
public final class DomainCommandHandler {
    private final Records<Domain> domains;
    private final DomainMissions missions;
    private final Sequence sequence;
    private final Quota quota;
    private final EventPublisher outbox;

    /**
     * Resources shared with missions.
     *
     * @param sequence of the desired state
     * @param quota for the size of all definitions
     */
    record Means(Sequence sequence, Quota quota) {}

    DomainCommandHandler(Records<Domain> domains, DomainMissions missions, Means means, EventPublisher outbox) {
        this.domains = domains;
        this.missions = missions;
        this.sequence = means.sequence();
        this.quota = means.quota();
        this.outbox = outbox;
    }

    /** @param now epoch ms */
    public CommandResult answer(DomainCommand command, long now) throws RefusedException {
        if (command instanceof DomainCommand.Create create) {
            return create(create, now);
        }
        Domain known = domains.get(command.domain());
        if (known == null) {
            throw new RefusedException(ErrorCode.UNKNOWN_DOMAIN, "there is no domain '" + command.domain() + "'");
        }
        if (command instanceof DomainCommand.Change change) {
            keep(known, known.changed(change.details(), now, sequence.next()));
            return about(known.domain(), "changed");
        }
        delete(known, ((DomainCommand.Delete) command).force(), now);
        return CommandResult.of("deleted").with("domain", known.domain());
    }

    private CommandResult create(DomainCommand.Create create, long now) throws RefusedException {
        if (domains.contains(create.domain())) {
            throw new RefusedException(
                    ErrorCode.DOMAIN_EXISTS,
                    "domain '%s' exists already; use 'change' to change it".formatted(create.domain()));
        }
        keep(null, Domain.of(create.domain(), create.details(), now, sequence.next()));
        return about(create.domain(), "created");
    }

    private void delete(Domain known, boolean force, long now) throws RefusedException {
        String domain = known.domain();
        List<String> active = missions.activeIn(domain);
        if (!active.isEmpty() && !force) {
            throw new RefusedException(
                    ErrorCode.MISSIONS_RUNNING,
                    "%d missions run in domain '%s', '%s' among them; stop them first, or delete with force"
                            .formatted(active.size(), domain, active.get(0)));
        }
        active.forEach(mission -> missions.stop(mission, now));
        quota.use(-known.toBytes().length);
        domains.put(domain, null);
        outbox.put(Topics.DOMAINS, domain, null);
    }

    /** @param before null if there was none */
    private void keep(Domain before, Domain domain) throws RefusedException {
        byte[] value = domain.toBytes();
        quota.replace(before == null ? null : before.toBytes(), value);
        domains.put(domain.domain(), domain);
        outbox.put(Topics.DOMAINS, domain.domain(), value);
    }

    private static CommandResult about(String domain, String status) {
        return CommandResult.of(status).with("domain", domain).with("topic", Topics.realtime(domain));
    }
}
