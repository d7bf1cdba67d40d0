package io.furrow.model.event;

import java.io.Serializable;
import java.time.Instant;
import java.util.List;
import java.util.regex.Pattern;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Notification;

/**
 * How the entities of a notification become records, whichever way the notification arrived.
 *
 * @param name stands in {@code ce_source} for a subscription that has no usable id
 * @param excluded entities of a type that one of these matches as a whole are dropped
 * @param origin of the events, and of the deletions
 */
public record NotificationRules(String name, List<Pattern> excluded, EventTimeRule times, Origin origin)
        implements Serializable {
    private static final Pattern SUBSCRIPTION = Pattern.compile("[A-Za-z0-9_.:-]{1,128}");

    /** The header {@code ce_source} of all records of a notification. */
    public String source(Notification notification) {
        return "/ngsi/"
                + notification
                        .subscriptionId()
                        .filter(id -> SUBSCRIPTION.matcher(id).matches())
                        .orElse(name);
    }

    public boolean excludes(Entity entity) {
        for (Pattern type : excluded) {
            if (type.matcher(entity.type()).matches()) {
                return true;
            }
        }
        return false;
    }

    /**
     * @param received when the notification arrived
     * @param source of {@link #source}
     */
    public EntityRecord record(Entity entity, FiwareScope scope, Instant received, String source) {
        if (entity.isDeleted()) {
            EntityDeletion deletion = EntityDeletion.of(entity, scope, received, times.maxSkew(), origin);
            return new EntityRecord(entity.id(), null, deletion.time(), deletion.headers(source), null);
        }
        EntityEvent event = EntityEvent.of(entity, scope, received, times, origin);
        return new EntityRecord(
                entity.id(),
                entity.toBytes(),
                event.time().time(),
                event.headers(source),
                event.time().fault());
    }
}
