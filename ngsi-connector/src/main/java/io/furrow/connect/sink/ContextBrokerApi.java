package io.furrow.connect.sink;

import java.util.Collection;
import java.util.List;
import java.util.Map;

import io.furrow.connect.broker.BrokerRequest;
import io.furrow.connect.broker.Outcome;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;

/** How one API of context brokers says what the sink needs; requests and answers only, nothing is sent here. */
interface ContextBrokerApi {
    /** A name of the API, as the option has it. */
    String name();

    /** The id under which the context broker keeps an entity. */
    String idOf(Update update);

    /** The update as one element of a batch, UTF-8 JSON. */
    byte[] render(Update update);

    /** Writes elements that {@link #render} made, all of one scope. */
    BrokerRequest write(FiwareScope scope, List<byte[]> elements);

    /**
     * What an answer 2xx to {@link #write}, or to a batch of deletions, refuses all the same: ids of the context broker, and its words.
     *
     * @param ids that the request named
     * @throws UnreadableException if that cannot be told
     */
    Map<String, String> refused(Outcome.Done answer, Collection<String> ids) throws UnreadableException;

    /** Deletes an entity. */
    BrokerRequest delete(EntityKey key);

    /** The entity as one element of a batch of deletions, UTF-8 JSON. */
    byte[] renderDeletion(EntityKey key);

    /**
     * Deletes the entities of elements that {@link #renderDeletion} made, all of one scope. The others are deleted also where some are
     * absent, but the answer need not say which.
     */
    BrokerRequest delete(FiwareScope scope, List<byte[]> elements);

    /** Deletes an attribute of an entity. */
    BrokerRequest delete(EntityKey key, EntityTimes.Name attribute);

    /** How many ids one {@link #read} may name. */
    int idsPerRead();

    /**
     * Asks for entities and the times of their attributes.
     *
     * @param ids with the types that are wanted, none for a deletion
     */
    BrokerRequest read(FiwareScope scope, Map<String, ? extends Collection<String>> ids);

    /**
     * The times in an answer to {@link #read}, by the ids that were asked for.
     *
     * @throws UnreadableException if the answer is none
     */
    Map<String, EntityTimes> times(Collection<String> asked, Outcome.Done answer) throws UnreadableException;
}
