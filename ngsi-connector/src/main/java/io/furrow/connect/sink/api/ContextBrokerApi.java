package io.furrow.connect.sink.api;

import java.util.Collection;
import java.util.List;
import java.util.Map;

import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;

/** Builds the requests and parses the answers of one API of context brokers; sends nothing. */
public interface ContextBrokerApi {
    /** The name of the API, as in the option. */
    String name();

    /**
     * The id under which the context broker stores an entity.
     *
     * @param type empty if unknown
     */
    String idOf(EntityKey key, String type);

    /** Whether the context broker has at most one entity with the id, whatever its type. */
    boolean isUnique(EntityKey key);

    /** The update as one element of a batch, UTF-8 JSON. */
    byte[] render(AttributeUpdate attributeUpdate);

    /** The attributes without a value, which {@link #render} leaves out because they have to be deleted instead. */
    default List<String> cleared(AttributeUpdate attributeUpdate) {
        return List.of();
    }

    /** Writes elements from {@link #render}, all of one scope. */
    BrokerRequest write(FiwareScope scope, List<byte[]> elements);

    /**
     * The rejected ids in an answer 2xx to {@link #write}, or to a batch of deletions, with the context broker's
     * reason.
     *
     * @param ids in the request
     * @throws UnreadableException if the answer does not name them
     */
    Map<String, String> refused(Outcome.Done answer, Collection<String> ids) throws UnreadableException;

    /**
     * Deletes an entity.
     *
     * @param type empty for all types with the id
     */
    BrokerRequest delete(EntityKey key, String type);

    /** The entity as one element of a batch of deletions, UTF-8 JSON; the type as in {@link #delete(EntityKey, String)}. */
    byte[] renderDeletion(EntityKey key, String type);

    /**
     * Deletes the entities of elements from {@link #renderDeletion}, all of one scope. Absent entities do not prevent
     * the deletion of the others, but the answer need not name them.
     */
    BrokerRequest delete(FiwareScope scope, List<byte[]> elements);

    /** Deletes an attribute of an entity. */
    BrokerRequest delete(EntityKey key, EntityTimes.Name attribute);

    /** The maximum number of ids in one {@link #read}. */
    int idsPerRead();

    /**
     * Requests entities and the times of their attributes.
     *
     * @param ids with the requested types, empty for all
     */
    BrokerRequest read(FiwareScope scope, Map<String, ? extends Collection<String>> ids);

    /**
     * The times in an answer to {@link #read}, by the requested ids.
     *
     * @throws UnreadableException if the answer has another format
     */
    Map<String, EntityTimes> times(Collection<String> asked, Outcome.Done answer) throws UnreadableException;
}
