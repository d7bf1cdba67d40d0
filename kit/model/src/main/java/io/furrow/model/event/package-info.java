/** What a change of an entity becomes on a topic: its identity, its time, its headers, or a dead letter. */
package io.furrow.model.event;
