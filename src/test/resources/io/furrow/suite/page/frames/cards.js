/** The map with the cards of the devices beside it, as many as are in view. */
import '/cards/cards.js';
import './map.js';
