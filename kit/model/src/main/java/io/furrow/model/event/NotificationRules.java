package io.furrow.model.event;

import java.io.Serializable;
import java.time.Instant;
import java.util.List;
import java.util.Optional;
import java.util.regex.Pattern;
import java.util.stream.Stream;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Notification;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Converts the entities of a notification, however received, to records.
 *
 * @param name used in {@code ce_source} for a subscription without a usable id
 * @param excluded entities are dropped if one of these matches their whole type
 * @param origin of the events and deletions
 */
public record NotificationRules(String name, List<Pattern> excluded, EventTimeRule times, Origin origin)
        implements Serializable {
    private static final String SERVICE_PATH = "servicePath";
    private static final Pattern PATH = Pattern.compile("/[!-+\\--~]*");
    private static final Pattern SUBSCRIPTION = Pattern.compile("[A-Za-z0-9_.:-]{1,128}");

    /** Returns the header {@code ce_source} of all records of a notification. */
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
     * Returns the scope of an entity of a notification. Its service path is that of the header; if the header has
     * several, the one that the context broker reports with the entity, otherwise the one at the entity's position.
     *
     * @param index of the entity among the readable ones
     * @param headers the scope of the headers
     * @throws UnreadableException if the header has a different number of distinct paths
     */
    public static FiwareScope scope(Notification notification, int index, FiwareScope headers)
            throws UnreadableException {
        if (headers.servicePath().indexOf(',') < 0) {
            return headers;
        }
        Optional<String> reported = notification
                .entities()
                .get(index)
                .text(SERVICE_PATH)
                .filter(path -> PATH.matcher(path).matches());
        if (reported.isPresent()) {
            return FiwareScope.of(headers.service(), reported.get());
        }
        String[] paths = headers.servicePath().split(",", -1);
        int place = notification.places().get(index);
        if (paths.length == notification.size()) {
            return FiwareScope.of(headers.service(), paths[place]);
        }
        if (Stream.of(paths).map(path -> FiwareScope.of("", path)).distinct().count() > 1) {
            throw new UnreadableException(
                    Reason.NOT_AN_ENTITY,
                    "entity %d of %d has no service path: the header Fiware-ServicePath has %d, %s"
                            .formatted(place + 1, notification.size(), paths.length, headers.servicePath()));
        }
        return FiwareScope.of(headers.service(), paths[0]);
    }

    /**
     * @param received when the notification was received
     * @param source result of {@link #source}
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
